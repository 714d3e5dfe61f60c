#pragma once

#include <algorithm>
#include <vector>

#include "tests/reference/noise.h"

namespace wrinkle::reference {

enum class Cell { f1, f2, f2_f1 };

/// The feature point of a lattice cell, relative to the cell. The cell's coordinates modulo 256 are hashed to 32 bits
/// (by Wellons's "lowbias32"), of which each axis takes ten.
template <class T>
Vec<T> feature_point(std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint64_t h = 0x9e3779b9 ^ static_cast<std::uint64_t>((x & 255) + 256 * (y & 255) + 65536 * (z & 255));
    const auto mix = [&](int shift, std::uint64_t factor) { h = ((h ^ (h >> shift)) * factor) & 0xffffffffULL; };
    mix(16, 0x7feb352d);
    mix(15, 0x846ca68b);
    mix(16, 1);
    const auto coordinate = [&](int shift) { return (T(h >> shift & 1023) + T(1) / 2) / 1024; };
    return {coordinate(0), coordinate(10), coordinate(20)};
}

/// The feature points of the 7 x 7 x 7 cells around a point, nearest first.
template <class T>
struct Neighbour {
    T distance{};
    Vec<T> away;  ///< from the feature point to the point
};

template <class T>
std::vector<Neighbour<T>> feature_neighbours(Vec<T> p) {
    const T cx = std::floor(p.x), cy = std::floor(p.y), cz = std::floor(p.z);
    std::vector<Neighbour<T>> all;
    for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j)
            for (int k = -3; k <= 3; ++k) {
                const Vec<T> cell{cx + i, cy + j, cz + k};
                const Vec<T> away =
                    p - cell -
                    feature_point<T>(static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                                     static_cast<std::int64_t>(cell.z));
                all.push_back({length(away), away});
            }
    std::partial_sort(all.begin(), all.begin() + 3, all.end(),
                      [](const auto& a, const auto& b) { return a.distance < b.distance; });
    all.resize(3);
    return all;
}

/// Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996.
template <class T>
NoiseValue<T> worley_noise(Vec<T> p, Cell feature) {
    const auto near = feature_neighbours(p);
    const auto from = [](const Neighbour<T>& n) {
        return NoiseValue<T>{n.distance, n.distance > 0 ? n.away * (1 / n.distance) : Vec<T>{}};
    };
    const NoiseValue<T> first = from(near[0]), second = from(near[1]);
    if (feature == Cell::f1) return first;
    if (feature == Cell::f2) return second;
    return {second.value - first.value, second.gradient - first.gradient};
}

/// How far p is, at least, from where the gradient jumps: half the difference of two distances that are equal where it
/// jumps, or the distance to the feature point, where it jumps as well.
template <class T>
T distance_to_jump(Vec<T> p, Cell feature) {
    const auto near = feature_neighbours(p);
    const T first = near[1].distance - near[0].distance, second = near[2].distance - near[1].distance;
    const T point = near[0].distance;
    if (feature == Cell::f1) return std::min(first / 2, point);
    return std::min({first / 2, second / 2, feature == Cell::f2 ? first / 2 : point});
}

}  // namespace wrinkle::reference
