#pragma once

#include <filesystem>

#include "scene/figure.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// Evaluates every panel of a figure and writes them as one PNG. Holds whole frames in memory. Throws Error.
void draw_figure(const Device& device, const Figure& figure, const std::filesystem::path& file);

}  // namespace wrinkle
