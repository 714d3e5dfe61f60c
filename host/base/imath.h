#pragma once

#include <ImathMatrix.h>
#include <ImathVec.h>

#include <algorithm>
#include <cmath>

#include "wrinkle/camera.h"

/// The vectors and matrices of public headers as Imath's, which compute, and back. Public headers hold arrays, so that
/// users of the library need no Imath.
namespace wrinkle {

inline Imath::V3d to_imath(const Vec3& v) { return {v[0], v[1], v[2]}; }
inline Vec3 to_array(const Imath::V3d& v) { return {v.x, v.y, v.z}; }

/// Transposed, as Imath's matrices act on row vectors: v * to_imath(m) is m v.
inline Imath::M44d to_imath(const Mat4& m) {
    Imath::M44d out;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) out[j][i] = m[i][j];
    return out;
}

inline Mat4 to_array(const Imath::M44d& m) {
    Mat4 out{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) out[i][j] = m[j][i];
    return out;
}

/// Of unit length, also where squares over- or underflow. Zero stays zero.
inline Imath::V3d direction(const Imath::V3d& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? (v / largest).normalized() : Imath::V3d(0);
}

/// Zero vectors are parallel to everything. The bound, 2e-4 degrees, leaves a plane that double resolves well.
inline bool parallel(const Imath::V3d& a, const Imath::V3d& b) {
    return !(direction(a).cross(direction(b)).length() > 4e-6);
}

}  // namespace wrinkle
