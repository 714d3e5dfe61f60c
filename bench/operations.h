#pragma once

#include <string>

namespace wrinkle::bench {

/// Floating-point operations of a kernel per pixel, counted in what clang makes of it on one lane: additions,
/// subtractions, multiplications, divisions and roots one each, fma two; comparisons, minima and signs none. Both sides
/// of a branch count. 0, not counted: loops that stay loops, and machines without clang.
double counted_operations(const std::string& source);

}  // namespace wrinkle::bench
