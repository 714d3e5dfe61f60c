#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "io/gbuffer_reader.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// A pixel whose world position the frame tells.
struct PositionSample {
    double x = 0, y = 0;  ///< pixel centre
    Vec3 position{};      ///< world
    double depth = 0;     ///< of the depth role; NaN without one
};

/// Samples of about `rows` rows spread over the frame, background left out. Empty without the position role.
std::vector<PositionSample> sample_positions(const GBufferReader& reader, std::uint32_t rows = 16);

/// How far from their pixels the positions project, in pixels. Positions behind the eye count as infinitely far.
struct Residual {
    double median = 0, p99 = 0;
    std::size_t count = 0;
};
Residual reprojection_residual(const Camera& camera, Size size, std::span<const PositionSample> samples);

/// Whether the depth of the samples is measured along the viewing axis or the ray; nothing when neither fits, or the
/// view is too narrow to tell.
std::optional<DepthKind> measure_depth_kind(const Camera& camera, std::span<const PositionSample> samples);

}  // namespace wrinkle
