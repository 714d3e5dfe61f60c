#pragma once

#include <span>
#include <string>

#include "io/residual.h"
#include "wrinkle/scene.h"

namespace wrinkle::io {

/// What seems to be wrong with a camera that does not fit the positions: the field of view belongs to the other side of
/// the picture, another camera fits, or none does, since the pass was rendered with depth of field or motion blur,
/// which scatter positions about their pixels.
std::string explain_misfit(const CameraSource& source, const Camera& camera, Size display, double pixel_aspect,
                           std::span<const PositionSample> samples);

}  // namespace wrinkle::io
