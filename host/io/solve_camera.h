#pragma once

#include <span>

#include "io/residual.h"
#include "wrinkle/camera.h"

namespace wrinkle::io {

/// The camera that saw these positions at these pixels of a picture of `size`: perspective or parallel, with as much of
/// shift, pixel aspect and skew as it takes to explain them. `pixel_aspect`: width of a pixel by its height, which is
/// taken to be right unless the positions say otherwise. Positions that are off (averages at edges) do little harm.
///
/// Throws Error when there are too few positions, or when they leave the camera open, as a plane does that faces it.
Camera solve_camera(std::span<const PositionSample> samples, Size size, double pixel_aspect);

}  // namespace wrinkle::io
