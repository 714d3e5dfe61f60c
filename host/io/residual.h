#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "io/gbuffer_reader.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// A pixel with its position in the world, from the frame's position pass.
struct PositionSample {
    double x = 0, y = 0;  ///< pixel centre, seen from the display window's first pixel
    Vec3 position{};      ///< world
    double depth = 0;     ///< of the depth role; NaN without one
};

/// Samples from a few rows spread over the frame, without the background. Empty when the frame has no positions.
/// Where depth says that all of a frame is background and its normals do not, depth counts as wrong.
std::vector<PositionSample> sample_positions(const GBufferReader& reader);

/// How far from their own pixels a camera projects the positions, in pixels. Positions behind the eye count as
/// infinitely far away.
struct Residual {
    double median = 0, p99 = 0;
    std::size_t count = 0;
};
Residual reprojection_residual(const Camera& camera, Size size, std::span<const PositionSample> samples);

/// Whether the depths of the samples are measured along the viewing axis (planar) or along the ray. Nothing when
/// neither fits, or when the view is so narrow that both do.
std::optional<DepthKind> measure_depth_kind(const Camera& camera, std::span<const PositionSample> samples);

/// By what share the depths of the samples are off, whichever of both they are meant to be: a median. 0 without depth.
double depth_misfit(const Camera& camera, std::span<const PositionSample> samples);

}  // namespace wrinkle
