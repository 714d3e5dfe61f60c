#pragma once

#include <algorithm>
#include <cmath>

#include "tests/reference/lighting.h"

namespace wrinkle::reference {

/// What a picture of a metal shows of the direction l: the octahedron |x| + |y| + |z| = 1, seen from z, and its lower
/// half turned out over the edges; linear between the vertices of a square.
template <class T>
Vec<T> metal_seen(const MetalPicture& picture, Vec<T> l) {
    const T sum = std::abs(l.x) + std::abs(l.y) + std::abs(l.z), x = l.x / sum, y = l.y / sum;
    const T across = l.z < 0 ? (l.x < 0 ? -1 : 1) * (1 - std::abs(y)) : x;
    const T up = l.z < 0 ? (l.y < 0 ? -1 : 1) * (1 - std::abs(x)) : y;
    const std::size_t cells = MetalPicture::kVertices - 1;
    const auto place = [&](T v) { return std::clamp((v + 1) / 2, T(0), T(1)) * T(cells); };
    const auto cell = [&](T v) { return std::min(static_cast<std::size_t>(v), cells - 1); };
    const std::size_t i = cell(place(across)), j = cell(place(up));
    const T s = place(across) - T(i), t = place(up) - T(j);
    const auto at = [&](std::size_t a, std::size_t b) { return from_array<T>(picture.seen[b * (cells + 1) + a]); };
    return (at(i, j) * (1 - s) + at(i + 1, j) * s) * (1 - t) + (at(i, j + 1) * (1 - s) + at(i + 1, j + 1) * s) * t;
}

/// What a bumped surface mirrors towards v, by such a picture.
template <class T>
Vec<T> mirrored_by_metal(const MetalPicture& picture, Vec<T> n, Vec<T> base, Vec<T> v) {
    const Vec<T> mirror = mirror_normal(n, base, v);
    return metal_seen(picture, mirror * (2 * dot(mirror, v)) - v);
}

}  // namespace wrinkle::reference
