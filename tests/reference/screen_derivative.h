#pragma once

#include "tests/reference/mat4.h"

namespace wrinkle::reference {

template <class T>
struct ScreenDerivative {
    Vec<T> dp_dx, dp_dy;
};

/// [Mik20 3.7, listing 10] Derivatives of the point where the ray of screen position (x, y) meets the plane through p
/// perpendicular to n. `m` maps (x, y, depth, 1) to homogeneous points in the space of p. The ray is a(x,y) + s c,
/// a = m0 x + m1 y + m3, c = m2; with plane = (n, -n.p) the meeting point is h = a (plane.c) - c (plane.a), linear in
/// x and y, and the derivative of h.xyz / h.w is the quotient rule.
template <class T>
ScreenDerivative<T> screen_derivative(Vec<T> p, Vec<T> n, const Mat4x4<T>& m, T x, T y) {
    const Vec4<T> plane{n.x, n.y, n.z, -dot(n, p)};
    const Vec4<T> c = column(m, 2), m0 = column(m, 0), m1 = column(m, 1), m3 = column(m, 3);
    const T plane_c = dot4(plane, c);
    const auto meet = [&](const Vec4<T>& a) {
        const T plane_a = dot4(plane, a);
        Vec4<T> h;
        for (int i = 0; i < 4; ++i) h[i] = a[i] * plane_c - c[i] * plane_a;
        return h;
    };
    const Vec4<T> h0 = meet(m0), h1 = meet(m1), h3 = meet(m3);
    Vec4<T> h;
    for (int i = 0; i < 4; ++i) h[i] = h0[i] * x + h1[i] * y + h3[i];
    const auto quotient = [&](const Vec4<T>& dh) {
        const auto one = [&](int i) { return (dh[i] * h[3] - h[i] * dh[3]) / (h[3] * h[3]); };
        return Vec<T>{one(0), one(1), one(2)};
    };
    return {quotient(h0), quotient(h1)};
}

/// The same for a pinhole at the origin: p(x, y) = r d(x, y), d = d0 + x dx + y dy. Differentiating
/// p = d (n.p) / (n.d) with n.p held fixed gives r (dx (n.d) - d (n.dx)) / (n.d).
template <class T>
ScreenDerivative<T> screen_derivative_pinhole(T r, Vec<T> n, Vec<T> d, Vec<T> dx, Vec<T> dy) {
    const T nd = dot(n, d);
    const auto one = [&](Vec<T> k) { return cross(n, cross(k, d)) * (r / nd); };  // = r (k (n.d) - d (n.k)) / (n.d)
    return {one(dx), one(dy)};
}

}  // namespace wrinkle::reference
