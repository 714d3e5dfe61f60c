#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tests/reference/lighting.h"
#include "tests/reference/scene_textures.h"
#include "tests/reference/screen_derivative.h"

namespace wrinkle::reference {

/// A pixel as a layer sees it: the surface that its stage bumps.
template <class T>
struct Surfel {
    Vec<T> position;  ///< world
    Vec<T> normal;
    ScreenDerivative<T> d;
    std::optional<TexCoord<T>> uv;  ///< of the UV plane; nothing when there is no plane or no derivative
    /// The renderer's tangents; nothing when there are none, or they are not finite.
    std::optional<TangentFrame<T>> vertex;
    bool vertex_planes = false;                                              ///< the G-buffer has planes of tangents
    std::function<std::optional<Vec2<T>>(const std::string&)> height_slope;  ///< of the plane of this name, per pixel
    std::optional<double> object{};                   ///< the object's index, if the frame has a plane of it
    std::function<T(const std::string&)> coverage{};  ///< by the Cryptomatte object of this name
    std::uint32_t front = 0;                          ///< bits of the id of the one in front
    /// The vector that these three planes hold; nothing where it is not finite.
    std::function<std::optional<Vec<T>>(const std::array<std::string, 3>&)> vector{};
};

/// Texture coordinates that are linear in the world point, with derivatives by the chain rule.
template <class T, class F>
TexCoord<T> linear_coordinates(const F& st, Vec<T> point, const ScreenDerivative<T>& d) {
    return {st(point), {st(d.dp_dx), st(d.dp_dy)}};
}

/// Whether a planar mapping sees a surface edge on, with a cosine below 1e-6. It has no tangent frame then.
template <class T>
bool edge_on(const UvMapping& m, Vec<T> n) {
    const Vec<T> axis = cross(from_array<T>(m.axis_u), from_array<T>(m.axis_v));
    return m.source == UvSource::planar && std::abs(dot(n, axis)) <= T(1e-6L) * length(n) * length(axis);
}

/// (s,t) = R(rotation) (scale (u,v)) + offset, with derivatives. Nothing when the UV plane has none.
template <class T>
std::optional<TexCoord<T>> map_coordinates(const UvMapping& m, const Surfel<T>& s) {
    std::optional<TexCoord<T>> uv = s.uv;
    if (m.source == UvSource::planar) {
        const Vec<T> u = from_array<T>(m.axis_u), v = from_array<T>(m.axis_v);
        uv = linear_coordinates([&](Vec<T> p) { return Vec2<T>{dot(u, p), dot(v, p)}; }, s.position, s.d);
    }
    if (!uv) return uv;
    const T c = std::cos(T(m.rotation)), sn = std::sin(T(m.rotation));
    const auto linear = [&](Vec2<T> a) {
        const T x = a.x * T(m.scale[0]), y = a.y * T(m.scale[1]);
        return Vec2<T>{c * x - sn * y, sn * x + c * y};
    };
    return TexCoord<T>{linear(uv->st) + Vec2<T>{T(m.offset[0]), T(m.offset[1])}, {linear(uv->d.dx), linear(uv->d.dy)}};
}

}  // namespace wrinkle::reference
