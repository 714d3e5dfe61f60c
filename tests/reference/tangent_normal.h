#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// [Mik20 eq. 15, listing 2] Tangent-space normal m to slope (dH/du, dH/dv): -m.xy / m.z, m.z kept positive and the
/// slope within 128. `flip` negates m.y (an image whose green points down). m = 0 is flat.
template <class T>
Vec2<T> slope_from_tangent_normal(Vec<T> m, bool flip = false) {
    const T z = std::max(std::abs(m.z), std::max(std::abs(m.x), std::abs(m.y)) / 128);
    if (z == 0) return {0, 0};
    return {-m.x / z, (flip ? m.y : -m.y) / z};
}

/// [Mik20 eq. 16] The same from two components of a unit normal; `epsilon` bounds 1 - x^2 - y^2 from below.
template <class T>
Vec2<T> slope_from_two_components(Vec2<T> m, T epsilon) {
    const T z = std::sqrt(std::max(epsilon, 1 - dot(m, m)));
    return {-m.x / z, -m.y / z};
}

/// [Mik20 eq. 12] The unit tangent-space normal of a slope.
template <class T>
Vec<T> tangent_normal_from_slope(Vec2<T> d) {
    return normalize(Vec<T>{-d.x, -d.y, 1});
}

}  // namespace wrinkle::reference
