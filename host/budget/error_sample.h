#pragma once

#include <cstdint>
#include <random>

#include "base/error_stats.h"
#include "run/band_check.h"
#include "run/pass_impl.h"

namespace wrinkle {

/// Errors of a pass's normals at a seeded sample of pixels, against the same scene in double on the same device. Pixels
/// are taken in runs of as many as a work-item evaluates; texture coordinates without derivatives need their
/// neighbours, so whole bands of the frame must be at hand.
class ErrorSample : public BandCheck {
public:
    /// Throws Error where the device has no double precision.
    ErrorSample(const Device& device, const Scene& scene, const Frame& frame, const ErrorBudget& budget,
                TextureStore* store = nullptr);

    /// Whether it can measure passes for another frame; a frame's camera is given to start().
    bool fits(const Frame& frame) const;

    /// Planes that it reads.
    const std::vector<std::string>& inputs() const override { return reference_.inputs(); }

    /// Begins anew: a frame in bands of `band_rows` rows, the last one shorter. The same pixels every time.
    void start(const Camera& camera, std::uint32_t band_rows) override;

    /// The next band: its planes, and what a pass made of them. Blocks.
    void add(const PlaneBuffers& inputs, const Rows& rows, PlaneBuffers& outputs, bool fp64) override;

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
