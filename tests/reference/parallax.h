#pragma once

#include <optional>

#include "tests/reference/pyramid.h"
#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// [Mik20 listing 11] The screen vector whose step along the surface is the tangential part of `dir`. Nothing when
/// dp_dx and dp_dy do not span the tangent plane of n.
template <class T>
std::optional<Vec2<T>> screen_vector(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy, Vec<T> dir) {
    const Vec<T> r1 = cross(dp_dy, n), r2 = cross(n, dp_dx);
    const T det = dot(dp_dx, r1);
    if (det == 0) return std::nullopt;
    return Vec2<T>{dot(r1, dir) / det, dot(r2, dir) / det};
}

/// [Mik20 listing 11] `dir` in texture space, per unit of its length or, when it is projected, per unit along n.
template <class T>
Vec2<T> project_to_texture(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy, TexDerivative<T> st, Vec<T> dir, bool projected) {
    const auto v = screen_vector(n, dp_dx, dp_dy, dir);
    const T climb = projected ? std::abs(dot(n, dir)) : T(1);
    if (!v || climb == 0) return {};
    return (st.dx * v->x + st.dy * v->y) * (1 / climb);
}

/// [Mik20 listing 12] From an offset in texture space to the surface, by the inverse of [d(s,t)/dx | d(s,t)/dy].
template <class T>
Vec<T> texture_offset_to_surface(Vec<T> sigma_x, Vec<T> sigma_y, TexDerivative<T> st, Vec2<T> offset) {
    const T det = determinant(st);
    if (det == 0) return {};
    const T vx = (st.dy.y * offset.x - st.dy.x * offset.y) / det, vy = (st.dx.x * offset.y - st.dx.y * offset.x) / det;
    return sigma_x * vx + sigma_y * vy;
}

/// [Mik20 4.3] The normal at the end of a movement along a screen vector. It is n when it would face away from the
/// viewer.
template <class T>
Vec<T> parallax_normal(Vec<T> n, Vec<T> dn_dx, Vec<T> dn_dy, Vec2<T> v, Vec<T> view) {
    const Vec<T> moved = n + dn_dx * v.x + dn_dy * v.y;
    return dot(moved, view) > 0 ? normalize(moved) : n;
}

/// The height at which a ray meets the heights. It goes down from h = 1 in steps, then refines `refine` times by regula
/// falsi, and interpolates once more without evaluating the heights. `heights(st)` is any function; at height h, the
/// ray is at the coordinates st + range (h - level).
template <class T, class Heights>
T parallax_march(const Heights& heights, Vec2<T> st, Vec2<T> range, T level, T step, int steps, int refine) {
    const auto gap = [&](T h) { return h - heights(st + range * (h - level)); };
    T above = 1, above_gap = gap(1), below = 0, below_gap = 0;
    if (above_gap <= 0) return 1;
    for (int i = 1;; ++i) {
        below = i >= steps ? T(0) : std::max(T(0), 1 - i * step);
        below_gap = gap(below);
        if (below_gap <= 0 || below == 0) break;
        above = below, above_gap = below_gap;
    }
    below_gap = std::min(below_gap, T(0));
    const auto crossing = [&] { return above + (below - above) * above_gap / (above_gap - below_gap); };
    for (int i = 0; i < refine; ++i) {
        const T h = crossing(), g = gap(h);
        if (g > 0)
            above = h, above_gap = g;
        else
            below = h, below_gap = g;
        if (above_gap == below_gap) return above;
    }
    return crossing();
}

/// The length of a step: half a texel of the level, as a share of the whole range, but at least 1 / steps.
template <class T>
T parallax_step(const Level<T>& top, Vec2<T> range, T lod, int steps) {
    const T texels = std::hypot(range.x * top.width, range.y * top.height) / std::exp2(lod);
    return std::max(T(1) / steps, 1 / std::max(T(1), 2 * texels));
}

}  // namespace wrinkle::reference
