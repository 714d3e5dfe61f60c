#include "run/frame_run.h"

#include <algorithm>
#include <future>
#include <thread>

namespace wrinkle {

namespace {

/// Rows of a band: whole ZIP blocks of EXR files, and enough of them for every core to decompress one while frames are
/// up to 4096 wide. More would leave cores idle longer at a run's start and end. Three bands are in flight.
constexpr std::uint32_t kBlockRows = 16;
constexpr std::size_t kCorePixels = std::size_t{1} << 16;
constexpr std::size_t kMostCores = 16;  // memory is bounded on any machine

std::uint32_t band_rows(Size size) {
    const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 2, kMostCores);
    const std::size_t blocks = std::max<std::size_t>(cores * kCorePixels / size.width / kBlockRows, 1);
    return static_cast<std::uint32_t>(std::min<std::size_t>(blocks * kBlockRows, size.height));
}

void add_missing(std::vector<std::string>& names, const std::vector<std::string>& more) {
    for (const std::string& name : more)
        if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}  // namespace

void FrameRun::measure(ErrorSample& sample, const Camera& camera) {
    sample_ = &sample;
    sample.start(camera, band_rows(pass_.size));
}

double FrameRun::run(const std::function<void(double)>& progress) {
    names_ = pass_.plan.inputs;
    if (outputs_ != nullptr) add_missing(names_, outputs_->passed_planes());
    if (sample_ != nullptr) add_missing(names_, sample_->inputs());
    if (condition_ != nullptr) add_missing(names_, condition_->inputs());
    const Size size = pass_.size;
    const std::uint32_t rows = band_rows(size), halo = pass_.plan.neighbours ? 1 : 0;
    std::array<Slot, 3> slots;
    for (Slot& slot : slots) {
        slot.inputs = PlaneBuffers(pass_.device, names_, std::size_t{size.width} * (rows + 2 * halo), sizeof(float));
        slot.outputs =
            PlaneBuffers(pass_.device, pass_.plan.outputs, std::size_t{size.width} * rows, pass_.bytes_per_output());
    }
    std::future<void> reading, writing;
    const auto start_reading = [&](std::uint32_t first, Slot& slot) {
        slot.rows.first = first;
        slot.rows.count = std::min(rows, size.height - first);
        slot.rows.before = std::min(halo, first);
        slot.rows.after = std::min(halo, size.height - first - slot.rows.count);
        reading = std::async(std::launch::async, [&, this] { read(slot); });
    };
    start_reading(0, slots[0]);
    for (std::uint32_t first = 0, band = 0; first < size.height; first += rows, ++band) {
        Slot& slot = slots[band % 3];
        reading.get();
        slot.inputs.unmap();
        if (first + rows < size.height) start_reading(first + rows, slots[(band + 1) % 3]);
        evaluate(slot);
        if (writing.valid()) writing.get();  // the slot before this one is free again
        if (outputs_ != nullptr) writing = std::async(std::launch::async, [&, this] { write(slot); });
        if (progress) progress(std::min(1.0, static_cast<double>(first + rows) / size.height));
    }
    if (writing.valid()) writing.get();
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
}

void FrameRun::evaluate(Slot& slot) {
    if (!pass_.warm) {  // drivers finish compiling at the first call: one row, counted as building
        clock_.measure(PhaseClock::build, [&] {
            Rows row = slot.rows;
            row.after += row.count - 1;
            row.count = 1;
            pass_.enqueue(slot.inputs.planes(), slot.outputs.planes(), row, {}).wait();
        });
        pass_.warm = true;
    }
    clock_.measure(PhaseClock::kernels, [&] {
        std::vector<double> times;
        for (int i = 0; i < std::max(repeat_, 1); ++i) {
            const auto start = PhaseClock::Clock::now();
            pass_.enqueue(slot.inputs.planes(), slot.outputs.planes(), slot.rows, {}).wait();
            times.push_back(std::chrono::duration<double>(PhaseClock::Clock::now() - start).count());
        }
        std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
        kernel_seconds_ += times[times.size() / 2];
    });
    if (condition_ != nullptr)
        clock_.measure(PhaseClock::check, [&] { slot.condition = condition_->evaluate(slot.inputs, slot.rows); });
    if (sample_ == nullptr) return;
    clock_.measure(PhaseClock::check,
                   [&] { sample_->add(slot.inputs.planes(), slot.rows, slot.outputs, pass_.options.fp64); });
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
