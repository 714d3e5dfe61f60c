#pragma once

#include <cstdint>
#include <random>

#include "run/error_stats.h"
#include "run/pass_impl.h"
#include "run/plane_buffers.h"

namespace wrinkle {

/// The scene without what normals do not depend on; `marked` tells invalid pixels.
Scene normals_only(Scene scene);

/// Errors of a pass's normals at a seeded sample of pixels, against the same scene in double on the same device. Pixels
/// are taken in runs of as many as a work-item evaluates; texture coordinates without derivatives need their
/// neighbours, so whole bands of the frame must be at hand.
class ErrorSample {
public:
    /// Throws Error where the device has no double precision.
    ErrorSample(const Device& device, const Scene& scene, const Frame& frame, const ErrorBudget& budget);

    /// Whether it can measure passes for another frame; a frame's camera is given to start().
    bool fits(const Frame& frame) const;

    /// Planes that it reads.
    const std::vector<std::string>& inputs() const { return reference_.inputs(); }

    /// Begins anew: a frame in bands of `band_rows` rows, the last one shorter. The same pixels every time.
    void start(const Camera& camera, std::uint32_t band_rows);

    /// The next band: what a pass made of `inputs`. Blocks.
    void add(const DevicePlanes& inputs, const Rows& rows, PlaneBuffers& outputs, bool fp64);

    ErrorStats stats() const { return statistics(degrees_); }

private:
    std::vector<Pass::Impl::Items> choose(std::size_t items);
    template <class T>
    void compare(std::size_t pixels, const std::vector<Pass::Impl::Items>& runs, PlaneBuffers& outputs);

    Pass reference_;
    Frame frame_;
    std::size_t wanted_ = 0;
    std::uint64_t seed_ = 0;
    std::mt19937_64 random_;
    std::size_t needed_ = 0, left_ = 0;  ///< work-items still to choose, and to choose from
    PlaneBuffers truth_;
    std::size_t truth_pixels_ = 0;
    std::vector<double> degrees_;
};

}  // namespace wrinkle
