#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// A pixel, as far as the rule for neighbours depends on it.
template <class T>
struct UvPixel {
    bool valid = false;
    std::optional<float> object;  ///< nothing when the G-buffer has no object plane
    Vec<T> normal;                ///< of the frame, made unit
    Vec<T> position;
    Vec2<T> uv;
};

/// Whether pixel j may be differenced with pixel i, along an axis of the picture with position derivative dp: there
/// must be no break of object, normal or depth between them.
template <class T>
bool same_surface(const UvPixel<T>& i, const UvPixel<T>& j, Vec<T> dp) {
    const Vec<T> step = j.position - i.position;
    return j.valid && i.object == j.object && dot(i.normal, j.normal) > T(1) / 2 && dot(step, step) <= 16 * dot(dp, dp);
}

/// A step in space between two pixels, and the change of the texture coordinates along it.
template <class T>
struct UvChange {
    Vec2<T> uv;
    Vec<T> step;
    UvChange operator*(T s) const { return {uv * s, step * s}; }
    UvChange operator+(const UvChange& b) const { return {uv + b.uv, step + b.step}; }
};

/// Whether a change of UV says nothing of a seam.
template <class T>
bool within_half(Vec2<T> d) {
    return std::abs(d.x) < T(1) / 2 && std::abs(d.y) < T(1) / 2;
}

/// The changes from `here` to the next pixel and from the one before, where there is no break of object, normal, depth
/// or UV between them. A change of half the texture is a break of UV unless the other change is about the same.
template <class T>
std::pair<std::optional<UvChange<T>>, std::optional<UvChange<T>>> uv_differences(const UvPixel<T>& here,
                                                                                 const UvPixel<T>& before,
                                                                                 const UvPixel<T>& after, Vec<T> dp) {
    const UvChange<T> forward{after.uv - here.uv, after.position - here.position},
        backward{here.uv - before.uv, here.position - before.position};
    const bool next = same_surface(here, after, dp), last = same_surface(here, before, dp);
    const bool steady = next && last && within_half(forward.uv - backward.uv);
    std::pair<std::optional<UvChange<T>>, std::optional<UvChange<T>>> out;
    if (next && (steady || within_half(forward.uv))) out.first = forward;
    if (last && (steady || within_half(backward.uv))) out.second = backward;
    return out;
}

/// The change along an axis, from a forward and a backward difference. When one step of UV is more than twice as long
/// as the other: the shorter one, unless that is zero. When they point in opposite directions, as at a seam that
/// mirrors: the longer one. Else their mean.
template <class T>
std::optional<UvChange<T>> combine_differences(std::optional<UvChange<T>> forward,
                                               std::optional<UvChange<T>> backward) {
    if (!forward) return backward;
    if (!backward) return forward;
    const T f = dot(forward->uv, forward->uv), b = dot(backward->uv, backward->uv);
    const auto &smaller = f <= b ? forward : backward, &larger = f < b ? backward : forward;
    if (std::max(f, b) > 4 * std::min(f, b)) return std::min(f, b) == 0 ? larger : smaller;
    if (dot(forward->uv, backward->uv) < 0) return larger;
    return (*forward + *backward) * (T(1) / 2);
}

/// d(u,v)/dx and d(u,v)/dy: the gradient that explains both changes, in an orthonormal basis of the tangent plane,
/// times dp_dx and dp_dy. When the steps span less than a 64th of the area that dp_dx and dp_dy span: the changes
/// themselves.
template <class T>
std::pair<Vec2<T>, Vec2<T>> uv_derivatives(const UvChange<T>& x, const UvChange<T>& y, Vec<T> dp_dx, Vec<T> dp_dy) {
    const Vec<T> first = normalize(dp_dx), second = normalize(dp_dy - first * dot(dp_dy, first));
    const auto flat = [&](Vec<T> v) { return Vec2<T>{dot(v, first), dot(v, second)}; };
    const auto area = [](Vec2<T> a, Vec2<T> b) { return a.x * b.y - a.y * b.x; };
    const Vec2<T> a = flat(x.step), b = flat(y.step), right = flat(dp_dx), down = flat(dp_dy);
    if (!(area(a, b) / area(right, down) > T(1) / 64)) return {x.uv, y.uv};
    const auto along = [&](Vec2<T> dp) {
        return x.uv * (area(dp, b) / area(a, b)) + y.uv * (area(a, dp) / area(a, b));
    };
    return {along(right), along(down)};
}

/// [Mik20 listing 7] The change of a height along an axis: to the next pixel or, when that is not on the same surface,
/// from the one before.
template <class T>
std::optional<T> height_difference(const UvPixel<T>& here, const UvPixel<T>& before, const UvPixel<T>& after, T h,
                                   T h_before, T h_after, Vec<T> dp) {
    if (same_surface(here, after, dp) && std::isfinite(h_after - h)) return h_after - h;
    if (same_surface(here, before, dp) && std::isfinite(h - h_before)) return h - h_before;
    return std::nullopt;
}

/// The change of the unit normal along an axis: the mean of the changes to those neighbours that lie on the same
/// surface; 0 when none does.
template <class T>
Vec<T> normal_difference(const UvPixel<T>& here, const UvPixel<T>& before, const UvPixel<T>& after, Vec<T> dp) {
    std::vector<Vec<T>> steps;
    if (same_surface(here, after, dp)) steps.push_back(after.normal - here.normal);
    if (same_surface(here, before, dp)) steps.push_back(here.normal - before.normal);
    Vec<T> sum;
    for (const Vec<T>& step : steps) sum = sum + step / T(steps.size());
    return sum;
}

/// d(u,v)/dx from dp/du and dp/dv: the least squares solution of dp_dx = a dp_du + b dp_dv. Nothing when dp_du and
/// dp_dv are parallel or zero.
template <class T>
std::optional<Vec2<T>> uv_derivative_from_tangents(Vec<T> dp, Vec<T> dp_du, Vec<T> dp_dv) {
    const Vec<T> n = cross(dp_du, dp_dv);
    const T det = dot(n, n);
    if (!(det > 0)) return std::nullopt;
    return Vec2<T>{dot(cross(dp, dp_dv), n) / det, dot(cross(dp_du, dp), n) / det};
}

}  // namespace wrinkle::reference
