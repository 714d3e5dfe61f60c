#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tests/reference/lighting.h"
#include "tests/reference/scene_textures.h"
#include "tests/reference/screen_derivative.h"

namespace wrinkle::reference {

/// What a layer sees of its pixel: the surface of its stage.
template <class T>
struct Surfel {
    Vec<T> position;  ///< world
    Vec<T> normal;
    ScreenDerivative<T> d;
    std::optional<TexCoord<T>> uv;          ///< the UV plane; nothing without plane or derivative
    std::optional<TangentFrame<T>> vertex;  ///< the renderer's tangents; nothing without planes, or not finite
    bool vertex_planes = false;             ///< the G-buffer has them
    std::function<std::optional<Vec2<T>>(const std::string&)> height_slope;  ///< of a plane, per pixel
    std::optional<double> object{};                   ///< the object's index, where the frame has it
    std::function<T(const std::string&)> coverage{};  ///< by a Cryptomatte object of this name
};

/// Coordinates that are linear in the world point: derivatives by the chain rule.
template <class T, class F>
TexCoord<T> linear_coordinates(const F& st, Vec<T> point, const ScreenDerivative<T>& d) {
    return {st(point), {st(d.dp_dx), st(d.dp_dy)}};
}

/// Whether a planar mapping sees a surface edge on, to a cosine of 1e-6: then it gives no tangent frame.
template <class T>
bool edge_on(const UvMapping& m, Vec<T> n) {
    const Vec<T> axis = cross(from_array<T>(m.axis_u), from_array<T>(m.axis_v));
    return m.source == UvSource::planar && std::abs(dot(n, axis)) <= T(1e-6L) * length(n) * length(axis);
}

/// (s,t) = R(rotation) (scale (u,v)) + offset, and its derivatives; nothing where the UV plane has none.
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
