#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "tests/reference/vec.h"

/// The functions of data/kernels, written again from what their comments say: heights in long double, and gradients by
/// central differences of those, so that no derivative is written by hand or copied.
namespace wrinkle::reference {

using Parameters = std::map<std::string, double>;

/// Height at coordinates (x, y, z), or (s, t), of a pixel whose footprint is so long.
using UserHeight = std::function<long double(const Parameters& k, const long double (&at)[3], long double footprint)>;

/// Three rounds of Wellons's "lowbias32", the upper 24 bits.
inline long double random_of_cell(long double i, long double j, std::uint32_t salt) {
    std::uint32_t h = salt;
    for (const long double whole : {i, j, 0.0L}) {
        h ^= static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
        h = (h ^ h >> 16) * 0x7feb352du;
        h = (h ^ h >> 15) * 0x846ca68bu;
        h ^= h >> 16;
    }
    return static_cast<long double>(h >> 8) / 16777216.0L;
}

/// A bowl (1 - d^2)^2 in every cell, somewhere within it and of a size of its own; finer than a pixel it fades.
inline long double dents_height(const Parameters& k, const long double (&at)[3], long double footprint) {
    const long double spacing = k.at("spacing"), most = k.at("radius");
    const long double u = at[0] / spacing, v = at[1] / spacing, i = std::floor(u), j = std::floor(v);
    const long double radius = most * (0.5L + 0.5L * random_of_cell(i, j, 0)), room = 1 - 2 * radius;
    const long double du = u - (i + radius + room * random_of_cell(i, j, 1));
    const long double dv = v - (j + radius + room * random_of_cell(i, j, 2));
    const long double bowl = std::max(1 - (du * du + dv * dv) / (radius * radius), 0.0L);
    const long double size = spacing * most, shown = std::min(std::max(2 - 2 * footprint / size, 0.0L), 1.0L);
    return -static_cast<long double>(k.at("depth")) * shown * bowl * bowl;
}

/// The same round bowl in every cell of the texture coordinates.
inline long double bowls_height(const Parameters& k, const long double (&st)[3], long double) {
    const long double radius = k.at("radius");
    const long double u = st[0] * k.at("columns"), v = st[1] * k.at("rows");
    const long double du = u - std::floor(u) - 0.5L, dv = v - std::floor(v) - 0.5L;
    const long double bowl = std::max(1 - (du * du + dv * dv) / (radius * radius), 0.0L);
    return bowl * bowl;
}

inline UserHeight user_height(const std::string& function) {
    if (function == "dents") return dents_height;
    if (function == "bowls") return bowls_height;
    throw std::invalid_argument("the reference has no function \"" + function + "\"");
}

/// Gradient along the coordinates, error about 1e-11 where the height is smooth.
inline Vec<long double> user_gradient(const UserHeight& height, const Parameters& k, const long double (&at)[3],
                                      long double footprint) {
    constexpr long double step = 1e-7L;
    long double slope[3];
    for (int axis = 0; axis < 3; ++axis) {
        long double ahead[3] = {at[0], at[1], at[2]}, behind[3] = {at[0], at[1], at[2]};
        ahead[axis] += step, behind[axis] -= step;
        slope[axis] = (height(k, ahead, footprint) - height(k, behind, footprint)) / (2 * step);
    }
    return {slope[0], slope[1], slope[2]};
}

}  // namespace wrinkle::reference
