#pragma once

#include <string>

#include "io/gbuffer_reader.h"
#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Says what is wrong where a frame's normals are not those of the surface that its own positions span, or without
/// positions its depths and `camera`, which is the one of all of the frame. Normals in another space, of other axes or
/// turned inside out look like any others, and bumps on them are wrong everywhere. Empty when they fit, as bumped
/// and smoothed normals do, and when too few pixels tell.
std::string normals_misfit(const GBufferReader& reader, const Camera& camera);

/// Says what is wrong with the depth of a frame that has no positions to compare it with: negative, or normalised.
/// Empty when it looks like a depth.
std::string depth_misfit(const GBufferReader& reader);

}  // namespace wrinkle::io
