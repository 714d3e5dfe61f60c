#pragma once

#include "tests/reference/perturbed_normal.h"
#include "tests/reference/resolve.h"
#include "tests/reference/tangent_normal.h"

namespace wrinkle::reference {

/// [Mik20 4.2] Blends of tangent-space normals a and b on one unwrap.
template <class T>
Vec<T> blend_partial_derivative(Vec<T> a, Vec<T> b) {
    const Vec<T> sum{a.x / a.z + b.x / b.z, a.y / a.z + b.y / b.z, 1};  // slopes, negated
    return normalize(sum * (a.z * b.z));
}
template <class T>
Vec<T> blend_whiteout(Vec<T> a, Vec<T> b) {
    return normalize(Vec<T>{a.x + b.x, a.y + b.y, a.z * b.z});
}
template <class T>
Vec<T> blend_udn(Vec<T> a, Vec<T> b) {
    return normalize(Vec<T>{a.x + b.x, a.y + b.y, a.z});
}
template <class T>
Vec<T> blend_linear(Vec<T> a, Vec<T> b) {
    return normalize(a + b);
}

/// [Mik20 eq. 18] as printed: not normalised.
template <class T>
Vec<T> blend_rnm(Vec<T> a, Vec<T> b) {
    const Vec<T> t{a.x, a.y, a.z + 1}, u{-b.x, -b.y, b.z};
    return t * (dot(t, u) / t.z) - u;
}

/// The shortest rotation from s to t, both unit, as a quaternion (cross(s, t), 1 + s.t) / sqrt(2 (1 + s.t)), applied to
/// u [Barre-Brisebois and Hill 2012].
template <class T>
Vec<T> reorient(Vec<T> s, Vec<T> t, Vec<T> u) {
    const T d = 1 + dot(s, t), k = std::sqrt(2 * d), w = d / k;
    const Vec<T> q = cross(s, t) / k;
    return u * (w * w - dot(q, q)) + q * (2 * dot(q, u)) + cross(q, u) * (2 * w);
}

enum class Blending { whiteout, udn, linear, rnm };

/// [Mik20 table 1] The same for bumps on different unwraps, given as surface gradients tangent to the unit normal n.
/// Both become tangent-space normals in some orthonormal frame, are changed as the table says, and their slopes are
/// added. Linear and RNM blend the two perturbed normals instead. No slope is limited here.
template <class T>
Vec<T> combine_gradients(Blending how, Vec<T> n, Vec<T> g, Vec<T> detail) {
    const Vec<T> t = normalize(cross(std::abs(n.x) < std::abs(n.y) ? Vec<T>{1, 0, 0} : Vec<T>{0, 1, 0}, n));
    const Vec<T> b = cross(n, t);
    const auto tangent_normal = [&](Vec<T> v) { return tangent_normal_from_slope(Vec2<T>{dot(v, t), dot(v, b)}); };
    const auto gradient = [&](Vec<T> m) { return (t * m.x + b * m.y) / -m.z; };
    const Vec<T> first = tangent_normal(g), second = tangent_normal(detail);
    switch (how) {
        case Blending::whiteout:
            return gradient({first.x, first.y, first.z * second.z}) +
                   gradient({second.x, second.y, first.z * second.z});
        case Blending::udn:
            return gradient(first) + gradient({second.x, second.y, first.z});
        case Blending::linear:
            return surface_gradient_from_normal(n, resolve(n, g) + resolve(n, detail));
        case Blending::rnm:
            break;
    }
    return surface_gradient_from_normal(n, reorient(n, resolve(n, g), resolve(n, detail)));
}

/// [Mik20 4.5] The surface gradient of a mean of two normals: the perturbed one, and another whose share is `weight`.
template <class T>
Vec<T> combine_towards(Vec<T> n, Vec<T> g, Vec<T> other, T weight) {
    return surface_gradient_from_normal(n, normalize(n - g) * (1 - weight) + other * weight);
}

}  // namespace wrinkle::reference
