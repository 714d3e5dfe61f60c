#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace wrinkle {

/// Rows of planes with one pixel where the given ones have scale x scale: the means of each; of normals their
/// direction, and of `marked` every bit that any pixel has. `width` and `rows` are those given, multiples of the scale.
std::vector<std::vector<float>> shrink_rows(std::span<const std::string> names, std::span<const float* const> planes,
                                            std::size_t width, std::size_t rows, std::size_t scale);

}  // namespace wrinkle
