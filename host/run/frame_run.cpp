#include "run/frame_run.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/limits.h"
#include "run/band_pipeline.h"

namespace wrinkle {

namespace {

/// Bands are whole ZIP blocks of EXR files, one for every core to decompress at a time while there are enough of them.
constexpr std::uint32_t kBlockRows = 16;

/// Bands from reading to written: more than stages, as the time that a band takes to decompress or compress varies.
constexpr std::uint32_t kInFlight = 5;

void add_missing(std::vector<std::string>& names, const std::vector<std::string>& more) {
    for (const std::string& name : more)
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}  // namespace

FrameRun::FrameRun(Pass::Impl& pass, const GBufferReader& reader, PhaseClock& clock)
    : pass_(pass),
      reader_(reader),
      clock_(clock),
      grid_(band_grid(pass, std::lcm(kBlockRows, reader.beauty_scale()), kInFlight)) {
}  // whole rows of the picture, too

void FrameRun::check_bands(BandCheck& check, const Camera& camera) {
    check_ = &check;
    check.start(camera, grid_.rows);
}

double FrameRun::run(const std::function<void(double)>& progress) {
    read_ = pass_.plan.inputs;
    if (check_ != nullptr) add_missing(read_, check_->inputs());
    if (condition_ != nullptr) add_missing(read_, condition_->inputs());
    passed_.clear();
    if (outputs_ != nullptr) add_missing(passed_, outputs_->passed_planes());
    std::erase_if(passed_, [&](const std::string& name) { return std::ranges::find(read_, name) != read_.end(); });
    const double bytes_of_pixel = static_cast<double>(sizeof(float) * (read_.size() + passed_.size()) +
                                                      pass_.bytes_per_output() * pass_.plan.outputs.size());
    check_memory(
        reader_.path().string(), kInFlight * bytes_of_pixel * static_cast<double>(grid_.read_pixels()),
        fmt::format("evaluating {} bands of {} x {} pixels at a time", kInFlight, grid_.size.width, grid_.rows));
    const std::uint32_t bands = grid_.count();
    std::vector<Slot> slots;
    for (std::uint32_t i = 0; i < std::min(bands, kInFlight); ++i) {
        Slot& slot = slots.emplace_back(Slot{Band(pass_, grid_, read_)});
        for (const std::string& name : passed_) slot.passed[name].resize(grid_.read_pixels());
    }
    const auto slot_of = [&](std::uint32_t band) -> Slot& { return slots[band % kInFlight]; };
    BandStages stages;
    stages.read = [&](std::uint32_t band) {
        slot_of(band).begin(grid_, band);
        read(slot_of(band));
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
        std::vector<std::string> names = read_;
        std::vector<float*> planes;
        for (const std::string& name : read_) planes.push_back(slot.inputs.map<float>(name, CL_MAP_WRITE));
        for (auto& [name, plane] : slot.passed) names.push_back(name), planes.push_back(plane.data());
        reader_.read_rows(slot.rows.first - slot.rows.before, slot.rows.first + slot.rows.count + slot.rows.after,
                          names, planes);
        if (matches_ == nullptr) return;
        std::map<std::string, const float*> shown;
        for (std::size_t i = 0; i < names.size(); ++i) shown[names[i]] = planes[i];
        const std::size_t rows = slot.rows.before + slot.rows.count + slot.rows.after;
        matches_->see(shown, rows * pass_.size.width);
    });
    slot.inputs.unmap();
}

void FrameRun::evaluate(Slot& slot) {
    if (!pass_.warm) {  // drivers finish compiling at the first call: rows of one pixel, counted as building
        clock_.measure(PhaseClock::build, [&] {
            Rows few = slot.rows;
            few.count = pass_.plan.sums_over;
            few.after += slot.rows.count - few.count;
            slot.enqueue(pass_, few).wait();
        });
        pass_.warm = true;
    }
    std::vector<cl::Event> done;
    clock_.measure(PhaseClock::kernels, [&] {
        std::vector<double> times;
        for (int i = 0; i < std::max(repeat_, 1); ++i) {
            const auto start = PhaseClock::Clock::now();
            done = {slot.enqueue(pass_, slot.rows)};
            done.front().wait();
            times.push_back(std::chrono::duration<double>(PhaseClock::Clock::now() - start).count());
        }
        std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
        kernel_seconds_ += times[times.size() / 2];
    });
    if (outputs_ != nullptr || check_ != nullptr) slot.outputs.fetch(done);
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
        for (const std::string& name : read_) planes[name] = slot.inputs.written<float>(name) + before;
        for (const auto& [name, plane] : slot.passed) planes[name] = plane.data() + before;
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
