#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// [Mik20 4.5, listing 15] Volume gradient of an image projected along z, slopes along the projector's x and y.
template <class T>
Vec<T> decal_volume_gradient(Vec2<T> d, Vec<T> axis_x, Vec<T> axis_y) {
    return axis_x * d.x + axis_y * d.y;
}

template <class T>
struct DecalBox {
    Vec<T> center, x, y, z, half_size;  ///< x, y, z orthonormal
};

/// The box of a decal: x has the direction of axis_x, y is the part of axis_y perpendicular to it, z = x cross y.
template <class T>
DecalBox<T> decal_box(Vec<T> center, Vec<T> axis_x, Vec<T> axis_y, Vec<T> half_size) {
    const Vec<T> x = normalize(axis_x);
    const Vec<T> y = normalize(axis_y - x * dot(x, axis_y));
    return {center, x, y, cross(x, y), half_size};
}

/// A point in the box's coordinates, in which the faces lie at -1 and 1.
template <class T>
Vec<T> decal_coordinates(const DecalBox<T>& box, Vec<T> offset) {
    return {dot(box.x, offset) / box.half_size.x, dot(box.y, offset) / box.half_size.y,
            dot(box.z, offset) / box.half_size.z};
}

/// Product over the axes of clamp((1 - |q|) / falloff, 0, 1); 1 inside the box when falloff is 0, 0 outside always.
template <class T>
T decal_box_weight(Vec<T> q, T falloff) {
    if (!(largest(q) <= 1)) return 0;
    if (falloff == 0) return 1;
    const auto fade = [&](T c) { return saturate((1 - std::abs(c)) / falloff); };
    return fade(q.x) * fade(q.y) * fade(q.z);
}

/// clamp((n.z - a0) / (a1 - a0), 0, 1); a step at a0 where both are equal.
template <class T>
T decal_angle_fade(T cosine, T a0, T a1) {
    if (a0 == a1) return cosine >= a0 ? T(1) : T(0);
    return saturate((cosine - a0) / (a1 - a0));
}

}  // namespace wrinkle::reference
