#pragma once

#include <nlohmann/json_fwd.hpp>

#include "look/look.h"

namespace wrinkle {

/// A pixel in numbers, as a table: normals, their angle, gradients of the layers, footprint, roughness, colours,
/// object.
nlohmann::json pixel_data(const LookImage& image, const LookPixel& pixel, std::uint32_t x, std::uint32_t y);

}  // namespace wrinkle
