#include "budget/error_sample.h"

#include <fmt/format.h>

#include "run/normals_only.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

const Device& with_double(const Device& device) {
    if (!device.info.fp64)
        throw Error(
            fmt::format("max_error needs double precision (cl_khr_fp64) to measure errors, and {} has none; choose "
                        "another --device (see \"wrinkle devices\"), or leave max_error out",
                        device.info.name));
    return device;
}

}  // namespace

ErrorSample::ErrorSample(const Device& device, const Scene& scene, const Frame& frame, const ErrorBudget& budget,
                         TextureStore* store)
    : reference_(evaluate(with_double(device), normals_only(scene), frame, {.fp64 = true}, store)),
      frame_(frame),
      wanted_(static_cast<std::size_t>(budget.sample)),
      seed_(static_cast<std::uint64_t>(budget.seed)) {}

bool ErrorSample::fits(const Frame& frame) const { return same_shape(frame, frame_); }

void ErrorSample::start(const Camera& camera, std::uint32_t band_rows) {
    reference_.set_camera(camera);
    const Pass::Impl& impl = reference_.impl();
    const auto lanes = static_cast<std::size_t>(impl.options.lanes);
    random_.seed(seed_);
    left_ = 0;
    for (std::uint32_t first = 0; first < impl.size.height; first += band_rows)
        left_ += (std::size_t{impl.size.width} * std::min(band_rows, impl.size.height - first) + lanes - 1) / lanes;
    needed_ = std::min((wanted_ + lanes - 1) / lanes, left_);
    degrees_.clear();
}

/// Selection sampling [Knuth, The Art of Computer Programming 2, 3.4.2, algorithm S]: runs of the band's work-items.
std::vector<Pass::Impl::Items> ErrorSample::choose(std::size_t items) {
    std::vector<Pass::Impl::Items> runs;
    for (std::size_t i = 0; i < items; ++i, --left_) {
        // 53 bits as a share of 1: distributions of <random> differ from library to library
        if (static_cast<double>(random_() >> 11) * 0x1p-53 * static_cast<double>(left_) >= static_cast<double>(needed_))
            continue;
        --needed_;
        if (!runs.empty() && runs.back().first + runs.back().count == i)
            ++runs.back().count;
        else
            runs.push_back({i, 1});
    }
    return runs;
}

void ErrorSample::add(const PlaneBuffers& inputs, const Rows& rows, PlaneBuffers& outputs, bool fp64) {
    Pass::Impl& impl = reference_.impl();
    const auto lanes = static_cast<std::size_t>(impl.options.lanes);
    const std::size_t pixels = std::size_t{rows.count} * impl.size.width;
    const std::vector<Pass::Impl::Items> runs = choose((pixels + lanes - 1) / lanes);
    if (runs.empty()) return;
    if (truth_pixels_ < pixels) {
        truth_ = PlaneBuffers(impl.device, impl.plan.outputs, pixels, sizeof(double));
        truth_pixels_ = pixels;
    }
    impl.enqueue(inputs.planes(), truth_.planes(), rows, both_ready(inputs, truth_), runs).wait();
    impl.save();
    if (fp64)
        compare<double>(pixels, runs, outputs);
    else
        compare<float>(pixels, runs, outputs);
}

template <class T>
void ErrorSample::compare(std::size_t pixels, const std::vector<Pass::Impl::Items>& runs, PlaneBuffers& outputs) {
    const double *want[3], *marked = truth_.map<double>("marked", CL_MAP_READ);
    const T* got[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string name = fmt::format("normal.{}", "xyz"[k]);
        want[k] = truth_.map<double>(name, CL_MAP_READ);
        got[k] = outputs.map<T>(name, CL_MAP_READ);
    }
    const auto lanes = static_cast<std::size_t>(reference_.impl().options.lanes);
    for (const Pass::Impl::Items& run : runs)
        for (std::size_t i = run.first * lanes; i < std::min((run.first + run.count) * lanes, pixels); ++i) {
            if ((static_cast<int>(marked[i]) & 1) != 0) continue;  // invalid: passed through
            const auto written = [&](std::size_t k) { return static_cast<double>(static_cast<float>(got[k][i])); };
            degrees_.push_back(
                angle_degrees({written(0), written(1), written(2)}, {want[0][i], want[1][i], want[2][i]}));
        }
    truth_.unmap();
    outputs.unmap();
}

}  // namespace wrinkle
