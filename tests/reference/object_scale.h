#pragma once

#include "tests/reference/perturbed_normal.h"
#include "tests/reference/resolve.h"

namespace wrinkle::reference {

/// A linear map by its columns.
template <class T>
struct Columns3 {
    Vec<T> x, y, z;
};

template <class T>
Vec<T> operator*(const Columns3<T>& m, Vec<T> v) {
    return m.x * v.x + m.y * v.y + m.z * v.z;
}

/// ["Exploring the Surface Gradient" eq. 17 to 19] The normal of the displaced surface of a scaled object, from its
/// tangents M (t + (g.t) n) and M (b + (g.b) n), for an orthonormal frame (t, b, n) of object space. The side that it
/// points to is decided by where M takes the inside of the object. Kernels use cofactors instead.
template <class T>
Vec<T> resolve_object(const Columns3<T>& m, Vec<T> n, Vec<T> g) {
    const Vec<T> t = normalize(cross(std::abs(n.x) < std::abs(n.y) ? Vec<T>{1, 0, 0} : Vec<T>{0, 1, 0}, n));
    const Vec<T> b = cross(n, t);
    const Vec<T> normal = normalize(cross(m * (t + n * dot(g, t)), m * (b + n * dot(g, b))));
    return dot(m.x, cross(m.y, m.z)) < 0 ? -normal : normal;
}

/// The surface gradient that resolves to this normal, on the normal of the object without bumps in world space.
template <class T>
Vec<T> surface_gradient_to_world(const Columns3<T>& m, Vec<T> n, Vec<T> g) {
    return surface_gradient_from_normal(resolve_object(m, n, Vec<T>{}), resolve_object(m, n, g));
}

}  // namespace wrinkle::reference
