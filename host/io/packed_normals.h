#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/band_reader.h"
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

/// Whether a file's normals look packed, by some of its rows. Rows that cannot be read say that they do not: the error
/// is left to the reading of all rows, which tells the first damaged one.
bool are_packed(BandReader& reader, const std::array<ChannelPlace, 3>& axes, std::span<const std::uint32_t> rows,
                std::size_t width);

}  // namespace wrinkle::io
