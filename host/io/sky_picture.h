#pragma once

#include <filesystem>
#include <functional>
#include <span>

namespace wrinkle::io {

/// A row of a picture of all directions by longitude and latitude, from the top one on, which has number 0.
struct SkyRow {
    int y, width, height;        ///< of the picture, pixels
    std::span<const float> rgb;  ///< radiance, three numbers a pixel; 0 or positive, and finite
};

/// Reads such a picture, stored in rows or in tiles, row by row: floating point, twice as wide as high, with channels
/// R, G and B. Throws Error where the file is none, or a pixel is no light.
void read_sky(const std::filesystem::path& file, const std::function<void(const SkyRow&)>& use);

}  // namespace wrinkle::io
