#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// Screen derivatives of a texture coordinate.
template <class T>
struct TexDerivative {
    Vec2<T> dx, dy;  ///< d(s,t)/dx, d(s,t)/dy
};

template <class T>
T determinant(TexDerivative<T> st) {
    return st.dx.x * st.dy.y - st.dx.y * st.dy.x;
}

template <class T>
struct TangentFrame {
    Vec<T> tangent, bitangent;  ///< orthonormal with n; zero where there is no frame
    bool degenerate = false;    ///< det d(s,t)/d(x,y) = 0: the texture coordinates define no frame
};

/// [Mik20 listing 9] The part of a tangent to n.
template <class T>
Vec<T> tangent_part(Vec<T> a, Vec<T> n) {
    return a - n * dot(a, n);
}

/// [Mik20 listing 9] +1 or -1: handedness of (dp/dx, n, dp/dy).
template <class T>
T flip_sign(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy) {
    return dot(dp_dy, cross(n, dp_dx)) < 0 ? T(-1) : T(1);
}

/// [Mik20 3.3, listing 4] Tangent frame from the screen derivatives of position and texture coordinate; n is unit.
template <class T>
TangentFrame<T> tangent_frame(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy, TexDerivative<T> st) {
    const T det = determinant(st);
    const T sign_det = det < 0 ? T(-1) : T(1);
    const Vec<T> raw = tangent_part(dp_dx, n) * (sign_det * st.dy.y) - tangent_part(dp_dy, n) * (sign_det * st.dx.y);
    if (det == 0 || is_zero(raw)) return {{}, {}, true};
    const Vec<T> tangent = normalize(raw);
    return {tangent, cross(n, tangent) * (sign_det * flip_sign(n, dp_dx, dp_dy)), false};
}

}  // namespace wrinkle::reference
