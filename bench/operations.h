#pragma once

#include <string>

namespace wrinkle::bench {

/// Floating-point operations of a kernel per pixel, counted in the code that clang makes of it for one lane. Additions,
/// subtractions, multiplications, divisions and roots count one each, fma two; comparisons, minima and signs nothing.
/// Both sides of a branch count. Returns 0 when they cannot be counted: a loop was not unrolled, or there is no clang.
double counted_operations(const std::string& source);

}  // namespace wrinkle::bench
