#pragma once

#include "tests/reference/decal.h"
#include "tests/reference/texcoord.h"

namespace wrinkle::reference {

/// Where a projector's image shows a point: (s,t) before any tiling, and how strong the decal is there.
template <class T>
struct ProjectedPoint {
    Vec2<T> st;
    T size = 1;  ///< the image's size at the point, as a share of its size at the base
    T weight = 0;
};

/// Projects a point into a box, ellipsoid or cone, which fades towards its border. A cone's image shrinks linearly from
/// the base on the -z face to the apex in the middle of the +z face, and ends where it is a 64th of its size.
template <class T>
ProjectedPoint<T> project(const Projector& row, const DecalBox<T>& box, Vec<T> position) {
    const Vec<T> q = decal_coordinates(box, position - box.center);
    ProjectedPoint<T> out;
    const auto fade = [&](T distance, int axis) {
        const T share = row.falloff[axis];
        return share == 0 ? T(1) : saturate((1 - distance) / share);
    };
    const auto st = [](T x, T y) { return Vec2<T>{(x + 1) / 2, (y + 1) / 2}; };
    const bool in_box = largest(q) <= 1;
    if (row.shape == ProjectorShape::cone) {
        out.size = (1 - q.z) / 2;
        if (!in_box || out.size < T(1) / 64) return out;
        const T x = q.x / out.size, y = q.y / out.size, radius = std::hypot(x, y);
        out.st = st(x, y);
        out.weight = radius <= 1 ? fade(radius, 0) * fade(std::abs(q.z), 2) : T(0);
        return out;
    }
    out.st = st(q.x, q.y);
    if (row.shape == ProjectorShape::sphere)
        out.weight = length(q) <= 1 ? fade(length(q), 0) : T(0);
    else
        out.weight = in_box ? fade(std::abs(q.x), 0) * fade(std::abs(q.y), 1) * fade(std::abs(q.z), 2) : T(0);
    return out;
}

/// The derivative of (s,t) along a direction. For a box, (s,t) is linear; for a cone, it is q.x / size with
/// size = (1 - q.z) / 2, so the quotient rule applies.
template <class T>
Vec2<T> projected_step(const Projector& row, const DecalBox<T>& box, Vec<T> position, Vec<T> direction) {
    const Vec<T> dq = decal_coordinates(box, direction);
    if (row.shape != ProjectorShape::cone) return {dq.x / 2, dq.y / 2};
    const Vec<T> q = decal_coordinates(box, position - box.center);
    const T size = (1 - q.z) / 2, d_size = -dq.z / 2;
    const auto quotient = [&](T x, T dx) { return (dx * size - x * d_size) / (size * size) / 2; };
    return {quotient(q.x, dq.x), quotient(q.y, dq.y)};
}

/// Applies a row to the sum of those before it, with the weight `mask`.
template <class T>
void add_projector(const Projector& row, const LayerTexture<T>& texture, const Surfel<T>& s, bool footprint, T mask,
                   Vec<T>& sum) {
    if (!(std::min({row.half_size[0], row.half_size[1], row.half_size[2]}) > 0)) return;
    const DecalBox<T> box = decal_box(from_array<T>(row.center), from_array<T>(row.axis_x), from_array<T>(row.axis_y),
                                      from_array<T>(row.half_size));
    const ProjectedPoint<T> at = project(row, box, s.position);
    T cosine = dot(s.normal, box.z);
    if (row.two_sided) cosine = std::abs(cosine);
    if (cosine <= 0) return;
    const T weight =
        at.weight * decal_angle_fade(cosine, T(row.angle_fade[0]), T(row.angle_fade[1])) * T(row.opacity) * mask;
    if (weight == 0) return;

    const bool tiles = row.wrap == Wrap::repeat;
    const Vec2<T> repeat{tiles ? T(row.repeat[0]) : T(1), tiles ? T(row.repeat[1]) : T(1)};
    const auto step = [&](Vec<T> direction) {
        const Vec2<T> d = projected_step(row, box, s.position, direction);
        return Vec2<T>{d.x * repeat.x, d.y * repeat.y};
    };
    const TexCoord<T> c{{at.st.x * repeat.x, at.st.y * repeat.y}, {step(s.d.dp_dx), step(s.d.dp_dy)}};
    const Vec2<T> slope = texture.slope(c, footprint);
    // The gradient of h(s(p), t(p)), axis by axis. Slopes without a unit are metres over the metres that the image is
    // wide at this point.
    const T width = 2 * at.size * box.half_size.x / repeat.x, height = 2 * at.size * box.half_size.y / repeat.y;
    const bool unitless = texture.content != Content::height;
    const T ds = slope.x * (unitless ? width : T(1)), dt = slope.y * (unitless ? height : T(1));
    const auto along = [&](Vec<T> axis) {
        const Vec2<T> d = step(axis);
        return ds * d.x + dt * d.y;
    };
    const Vec<T> g = Vec<T>{along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})} * T(row.scale);
    if (row.mode == ProjectorMode::replace) sum = sum * (1 - weight);
    sum = sum + g * weight;
}

}  // namespace wrinkle::reference
