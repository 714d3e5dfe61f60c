#pragma once

#include "base/imath.h"

/// Imath's operations on the vectors of public headers.
namespace wrinkle {

inline double dot(const Vec3& a, const Vec3& b) { return to_imath(a).dot(to_imath(b)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return to_array(to_imath(a).cross(to_imath(b))); }
inline Vec3 subtract(const Vec3& a, const Vec3& b) { return to_array(to_imath(a) - to_imath(b)); }
inline Vec3 normalize(const Vec3& a) { return to_array(direction(to_imath(a))); }
inline bool parallel(const Vec3& a, const Vec3& b) { return parallel(to_imath(a), to_imath(b)); }

}  // namespace wrinkle
