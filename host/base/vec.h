#pragma once

#include <algorithm>
#include <cmath>

#include "wrinkle/camera.h"

/// The few vector functions that descriptions and cameras need, in double.
namespace wrinkle {

inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vec3 subtract(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Scaled first, so that vectors of any length keep their direction. Zero stays zero.
inline Vec3 normalize(const Vec3& a) {
    const double largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
    if (!(largest > 0)) return {0, 0, 0};
    const Vec3 scaled{a[0] / largest, a[1] / largest, a[2] / largest};
    const double length = std::hypot(scaled[0], scaled[1], scaled[2]);
    return {scaled[0] / length, scaled[1] / length, scaled[2] / length};
}

/// Zero vectors are parallel to everything. The bound, 2e-4 degrees, leaves a plane that double resolves well.
inline bool parallel(const Vec3& a, const Vec3& b) {
    const Vec3 c = cross(normalize(a), normalize(b));
    return !(std::hypot(c[0], c[1], c[2]) > 4e-6);
}

}  // namespace wrinkle
