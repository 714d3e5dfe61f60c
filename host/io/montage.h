#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// A picture to show, as a PNG holds it: red, green and blue of every pixel in [0,1], top row first.
struct MontagePart {
    Size size;
    std::vector<float> rgb;
    std::string caption;
};

/// Writes equally large pictures side by side, `columns` in a row (0: all), each with its caption below, on white, as a
/// PNG. Captions are set in DejaVu Sans, smaller where they would be wider than their picture. Throws Error when that
/// font is not installed.
void write_montage(const std::filesystem::path& file, std::span<const MontagePart> parts, int columns);

}  // namespace wrinkle
