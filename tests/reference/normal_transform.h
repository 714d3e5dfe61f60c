#pragma once

#include <array>

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// The normal, not of unit length, of a surface that is moved by a matrix (given by rows). It is perpendicular to the
/// moved tangents, and on the same side. Found from two tangents, while kernels use cofactors.
template <class T>
Vec<T> transform_normal(const std::array<std::array<double, 3>, 3>& m, Vec<T> n) {
    const auto moved = [&](Vec<T> p) {
        const auto row = [&](int i) { return T(m[i][0]) * p.x + T(m[i][1]) * p.y + T(m[i][2]) * p.z; };
        return Vec<T>{row(0), row(1), row(2)};
    };
    const Vec<T> other = std::abs(n.x) < std::abs(n.y) ? Vec<T>{1, 0, 0} : Vec<T>{0, 1, 0};
    const Vec<T> a = normalize(cross(n, other)), b = cross(n, a);
    const Vec<T> image = cross(moved(a), moved(b));
    return dot(image, moved(n)) < 0 ? image * T(-1) : image;
}

}  // namespace wrinkle::reference
