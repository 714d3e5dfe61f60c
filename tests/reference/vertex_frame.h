#pragma once

#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// [Mik20 listing 9] mikktsTangent and mikktsBitangent, from the interpolated normal, tangent and sign.
template <class T>
TangentFrame<T> vertex_frame(Vec<T> n, Vec<T> tangent, T sign) {
    const T size = length(n);
    if (size == 0) return {};
    return {tangent / size, cross(n / size, tangent) * (sign > 0 ? T(1) : T(-1)), false};
}

/// [Mik20 eq. 11] What a renderer without surface gradients computes: t m.x + b m.y + n m.z, normalised, on the
/// interpolated vectors as they are.
template <class T>
Vec<T> mikkt_normal(Vec<T> n, Vec<T> tangent, T sign, Vec<T> m) {
    return normalize(tangent * m.x + cross(n, tangent) * ((sign > 0 ? T(1) : T(-1)) * m.y) + n * m.z);
}

}  // namespace wrinkle::reference
