#pragma once

#include <cstddef>
#include <span>

#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Whether normals seem to be stored as (n + 1) / 2: all components are in [0, 1], and most vectors have unit length
/// once they are unpacked but not before.
bool looks_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z);

/// Whether a component lies outside [0, 1]. Normals that are not packed nearly always have one that does.
bool cannot_be_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z);

/// Turns vectors of camera space into world space, in place.
void turn_normals(const Mat4& view, std::span<float> x, std::span<float> y, std::span<float> z);

/// n = 2 c - 1, in place. What no normal is stored as becomes (0, 0, 0), the background: black, grey, white.
void unpack_normals(std::span<float> x, std::span<float> y, std::span<float> z);

}  // namespace wrinkle::io
