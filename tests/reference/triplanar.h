#pragma once

#include "tests/reference/volume_gradient.h"

namespace wrinkle::reference {

/// [Mik20 listing 14] Weights of the three projections: pow(max(0, |n| - 0.2), k), normalised. They are divided by the
/// largest one before the power, so that they do not all underflow when k is large.
template <class T>
Vec<T> triplanar_weights(Vec<T> n, T k) {
    const T fifth = T(1) / T(5);
    const auto above = [&](T c) { return std::max(T(0), std::abs(c) - fifth); };
    Vec<T> w{above(n.x), above(n.y), above(n.z)};
    const T m = largest(w);
    if (m == 0) return {};
    w = {std::pow(w.x / m, k), std::pow(w.y / m, k), std::pow(w.z / m, k)};
    return w / (w.x + w.y + w.z);
}

/// [Mik20 eq. 19, listing 13] Volume gradient of three weighted projections whose slopes were sampled with (z,y), (x,z)
/// and (x,y).
template <class T>
Vec<T> triplanar_volume_gradient(Vec<T> w, Vec2<T> x_plane, Vec2<T> y_plane, Vec2<T> z_plane) {
    return {w.z * z_plane.x + w.y * y_plane.x, w.z * z_plane.y + w.x * x_plane.y, w.x * x_plane.x + w.y * y_plane.y};
}

/// The sampling coordinates of the three planes for a point, before division by the tile.
template <class T>
Vec2<T> x_plane_st(Vec<T> p) {
    return {p.z, p.y};
}
template <class T>
Vec2<T> y_plane_st(Vec<T> p) {
    return {p.x, p.z};
}
template <class T>
Vec2<T> z_plane_st(Vec<T> p) {
    return {p.x, p.y};
}

}  // namespace wrinkle::reference
