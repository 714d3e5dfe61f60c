#pragma once

#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// [Mik20 eq. 7] dH/dx, dH/dy on the screen from slopes per unit s and t: the chain rule.
template <class T>
Vec2<T> screen_slope(Vec2<T> dh_dst, TexDerivative<T> st) {
    return {dot(dh_dst, st.dx), dot(dh_dst, st.dy)};
}

/// [Mik20 eq. 7, listing 6] Scale-dependent surface gradient from screen slopes h = (dH/dx, dH/dy).
template <class T>
Vec<T> surface_gradient_from_screen_slope(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy, Vec2<T> h) {
    const Vec<T> r1 = cross(dp_dy, n), r2 = cross(n, dp_dx);
    const T det = dot(dp_dx, r1);
    if (det == 0) return {};
    return (r1 * h.x + r2 * h.y) / det;
}

template <class T>
Vec<T> surface_gradient_scale_dependent(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy, TexDerivative<T> st, Vec2<T> dh_dst) {
    return surface_gradient_from_screen_slope(n, dp_dx, dp_dy, screen_slope(dh_dst, st));
}

}  // namespace wrinkle::reference
