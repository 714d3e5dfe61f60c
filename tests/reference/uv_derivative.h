#pragma once

#include <optional>

#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// What the neighbour rule looks at in one pixel.
template <class T>
struct UvPixel {
    bool valid = false;
    std::optional<float> object;  ///< nothing when the G-buffer has no object plane
    Vec<T> normal;                ///< as it came, but unit
    Vec<T> position;
    Vec2<T> uv;
};

/// Whether j may be differenced with i along an axis of position derivative dp: no object, normal or depth break.
template <class T>
bool same_surface(const UvPixel<T>& i, const UvPixel<T>& j, Vec<T> dp) {
    const Vec<T> step = j.position - i.position;
    return j.valid && i.object == j.object && dot(i.normal, j.normal) > T(1) / 2 && dot(step, step) <= 16 * dot(dp, dp);
}

/// uv[j] - uv[i] if j may be differenced with i along an axis of position derivative dp: no object, normal, depth or UV
/// break between them.
template <class T>
std::optional<Vec2<T>> uv_difference(const UvPixel<T>& i, const UvPixel<T>& j, Vec<T> dp) {
    const Vec2<T> d = j.uv - i.uv;
    const T half = T(1) / 2;
    const bool same_chart = std::abs(d.x) < half && std::abs(d.y) < half;
    if (!same_surface(i, j, dp) || !same_chart) return std::nullopt;
    return d;
}

/// The derivative from a forward and a backward difference: the smaller where one is more than twice the other, else
/// the mean.
template <class T>
std::optional<Vec2<T>> combine_differences(std::optional<Vec2<T>> forward, std::optional<Vec2<T>> backward) {
    if (!forward) return backward;
    if (!backward) return forward;
    const T f = dot(*forward, *forward), b = dot(*backward, *backward);
    if (f > 4 * b) return backward;
    if (b > 4 * f) return forward;
    return (*forward + *backward) * (T(1) / 2);
}

/// d(u,v)/dx from dp/du and dp/dv: the least squares solution of dp_dx = a dp_du + b dp_dv; nothing where dp_du and
/// dp_dv are parallel or zero.
template <class T>
std::optional<Vec2<T>> uv_derivative_from_tangents(Vec<T> dp, Vec<T> dp_du, Vec<T> dp_dv) {
    const Vec<T> n = cross(dp_du, dp_dv);
    const T det = dot(n, n);
    if (!(det > 0)) return std::nullopt;
    return Vec2<T>{dot(cross(dp, dp_dv), n) / det, dot(cross(dp_du, dp), n) / det};
}

}  // namespace wrinkle::reference
