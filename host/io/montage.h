#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// A picture with its caption. Red, green and blue of every pixel are in [0,1], as a PNG holds them; the top row is
/// first.
struct MontagePart {
    Size size;
    std::vector<float> rgb;
    std::string caption;
};

/// Writes a PNG with pictures of equal size side by side, `columns` in a row (0: all of them), each above its caption.
/// Captions are set in DejaVu Sans, in a smaller size when they would be wider than the picture. Throws Error when that
/// font is not installed.
void write_montage(const std::filesystem::path& file, std::span<const MontagePart> parts, int columns);

}  // namespace wrinkle
