#pragma once

#include <cstddef>
#include <span>

namespace wrinkle::io {

/// Normals stored as (n + 1) / 2, judged by their values: all in [0, 1], and unit length once unpacked but not before.
bool looks_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z);

/// Whether a component lies outside [0, 1], as one of some pixel nearly always does where normals are not packed.
bool cannot_be_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z);

/// n = 2 c - 1 in place. (0, 0, 0) stays: no normal is stored so, it is the background.
void unpack_normals(std::span<float> x, std::span<float> y, std::span<float> z);

}  // namespace wrinkle::io
