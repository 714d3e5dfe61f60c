#include "run/frame_run.h"

#include <algorithm>
#include <numeric>
#include <thread>

#include <fmt/format.h>

#include "base/limits.h"
#include "run/band_pipeline.h"

namespace wrinkle {

namespace {

/// Rows of a band: whole ZIP blocks of EXR files, and enough of them for every core to decompress one while frames are
/// up to 4096 wide. More would leave cores idle longer at a run's start and end.
constexpr std::uint32_t kBlockRows = 16;
constexpr std::size_t kCorePixels = std::size_t{1} << 16;
constexpr std::size_t kMostCores = 16;  // memory is bounded on any machine

/// Bands from reading to written: more than stages, as the time that a band takes to decompress or compress varies.
constexpr std::uint32_t kInFlight = 5;

std::uint32_t band_rows(Size size, std::uint32_t scale) {
    const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 2, kMostCores);
    const std::size_t step = std::lcm(kBlockRows, scale);  // bands hold whole rows of the picture, too
    const std::size_t blocks = std::max<std::size_t>(cores * kCorePixels / size.width / step, 1);
    return static_cast<std::uint32_t>(std::min<std::size_t>(blocks * step, size.height));
}

void add_missing(std::vector<std::string>& names, const std::vector<std::string>& more) {
    for (const std::string& name : more)
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}  // namespace

void FrameRun::check_bands(BandCheck& check, const Camera& camera) {
    check_ = &check;
    check.start(camera, band_rows(pass_.size, reader_.beauty_scale()));
}

double FrameRun::run(const std::function<void(double)>& progress) {
    names_ = pass_.plan.inputs;
    if (outputs_ != nullptr) add_missing(names_, outputs_->passed_planes());
    if (check_ != nullptr) add_missing(names_, check_->inputs());
    if (condition_ != nullptr) add_missing(names_, condition_->inputs());
    const Size size = pass_.size;
    const std::uint32_t rows = band_rows(size, reader_.beauty_scale()), halo = pass_.plan.neighbours ? 1 : 0;
    const double bytes_of_pixel =
        static_cast<double>(sizeof(float) * names_.size() + pass_.bytes_per_output() * pass_.plan.outputs.size());
    check_memory(reader_.path().string(), kInFlight * bytes_of_pixel * size.width * (rows + 2 * halo),
                 fmt::format("evaluating {} bands of {} x {} pixels at a time", kInFlight, size.width, rows));
    std::array<Slot, kInFlight> slots;
    for (Slot& slot : slots) {
        slot.inputs = PlaneBuffers(pass_.device, names_, std::size_t{size.width} * (rows + 2 * halo), sizeof(float));
        slot.outputs =
            PlaneBuffers(pass_.device, pass_.plan.outputs, std::size_t{size.width} * rows, pass_.bytes_per_output());
    }
    const auto slot_of = [&](std::uint32_t band) -> Slot& { return slots[band % kInFlight]; };
    const std::uint32_t bands = (size.height + rows - 1) / rows;
    BandStages stages;
    stages.read = [&](std::uint32_t band) {
        const std::uint32_t first = band * rows, count = std::min(rows, size.height - first);
        Slot& slot = slot_of(band);
        slot.rows = {.first = first,
                     .count = count,
                     .before = std::min(halo, first),
                     .after = std::min(halo, size.height - first - count)};
        read(slot);
    };
    stages.evaluate = [&](std::uint32_t band) {
        evaluate(slot_of(band));
        if (progress) progress((band + 1.0) / bands);
    };
    stages.write = [&](std::uint32_t band) {
        if (outputs_ != nullptr) write(slot_of(band));
    };
    run_bands(bands, kInFlight, stages);
    return kernel_seconds_;
}

void FrameRun::read(Slot& slot) {
    clock_.measure(PhaseClock::read, [&] {
        std::vector<float*> planes;
        for (const std::string& name : names_) planes.push_back(slot.inputs.map<float>(name, CL_MAP_WRITE));
        reader_.read_rows(slot.rows.first - slot.rows.before, slot.rows.first + slot.rows.count + slot.rows.after,
                          names_, planes);
        if (matches_ == nullptr) return;
        std::map<std::string, const float*> shown;
        for (std::size_t i = 0; i < names_.size(); ++i) shown[names_[i]] = planes[i];
        const std::size_t rows = slot.rows.before + slot.rows.count + slot.rows.after;
        matches_->see(shown, rows * pass_.size.width);
    });
    slot.inputs.unmap();
}

cl::Event FrameRun::enqueue(const Slot& slot, const Rows& rows) {
    return pass_.enqueue(slot.inputs.planes(), slot.outputs.planes(), rows, both_ready(slot.inputs, slot.outputs));
}

void FrameRun::evaluate(Slot& slot) {
    if (!pass_.warm) {  // drivers finish compiling at the first call: rows of one pixel, counted as building
        clock_.measure(PhaseClock::build, [&] {
            Rows few = slot.rows;
            few.count = pass_.plan.sums_over;
            few.after += slot.rows.count - few.count;
            enqueue(slot, few).wait();
        });
        pass_.warm = true;
    }
    clock_.measure(PhaseClock::kernels, [&] {
        std::vector<double> times;
        for (int i = 0; i < std::max(repeat_, 1); ++i) {
            const auto start = PhaseClock::Clock::now();
            enqueue(slot, slot.rows).wait();
            times.push_back(std::chrono::duration<double>(PhaseClock::Clock::now() - start).count());
        }
        std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
        kernel_seconds_ += times[times.size() / 2];
    });
    if (condition_ != nullptr)
        clock_.measure(PhaseClock::check, [&] { slot.condition = condition_->evaluate(slot.inputs, slot.rows); });
    if (check_ == nullptr) return;
    clock_.measure(PhaseClock::check, [&] { check_->add(slot.inputs, slot.rows, slot.outputs, pass_.options.fp64); });
}

void FrameRun::write(Slot& slot) {
    clock_.measure(PhaseClock::write, [&] {
        const std::size_t before = std::size_t{slot.rows.before} * pass_.size.width;
        const std::size_t pixels = std::size_t{slot.rows.count} * pass_.size.width;
        std::map<std::string, const float*> planes;
        for (const std::string& name : names_) planes[name] = slot.inputs.map<float>(name, CL_MAP_READ) + before;
        for (const std::string& name : pass_.plan.outputs) {
            if (pass_.options.fp64) {
                const double* wide = slot.outputs.map<double>(name, CL_MAP_READ);
                slot.narrowed[name].assign(wide, wide + pixels);
                planes["out:" + name] = slot.narrowed[name].data();
            } else {
                planes["out:" + name] = slot.outputs.map<float>(name, CL_MAP_READ);
            }
        }
        if (condition_ != nullptr) planes["out:condition"] = slot.condition.data();
        outputs_->write(slot.rows.first, slot.rows.first + slot.rows.count, planes);
        slot.inputs.unmap();
        slot.outputs.unmap();
    });
}

}  // namespace wrinkle
