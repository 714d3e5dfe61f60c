#pragma once

#include "tests/reference/layers.h"
#include "tests/reference/object_scale.h"
#include "tests/reference/triplanar.h"

namespace wrinkle::reference {

/// Object to world: scale, then turn about x, y and z.
template <class T>
Columns3<T> placement_matrix(const Placement& at) {
    const auto turned = [&](Vec<T> v) {
        const auto turn = [](T& a, T& b, T angle) {
            const T old = a;
            a = std::cos(angle) * old - std::sin(angle) * b, b = std::sin(angle) * old + std::cos(angle) * b;
        };
        turn(v.y, v.z, T(at.rotate[0])), turn(v.z, v.x, T(at.rotate[1])), turn(v.x, v.y, T(at.rotate[2]));
        return v;
    };
    return {turned({T(at.scale[0]), 0, 0}), turned({0, T(at.scale[1]), 0}), turned({0, 0, T(at.scale[2])})};
}

/// One of the three planes, as a map from a vector of the world to the plane's coordinates in metres.
template <class T>
using PlaneCoordinates = std::function<Vec2<T>(Vec<T>)>;

/// Slopes along a plane's coordinates, in metres per metre; or, of object-space normals, what they make of n.
template <class T>
struct PlaneBump {
    Vec2<T> slope;
    Vec<T> surface;
};

template <class T>
using PlaneFunction = std::function<PlaneBump<T>(const PlaneCoordinates<T>& plane, const Surfel<T>& s)>;

/// A plane that shows a picture. Its options are those of the paper: where they change the sign of a sampling
/// coordinate, the slope along it changes sign, too.
template <class T>
PlaneFunction<T> plane_of(const TextureUse& use, const TriplanarLayer& layer, bool footprint,
                          SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(use, use.content), content = use.content](const PlaneCoordinates<T>& plane,
                                                                                   const Surfel<T>& s) -> PlaneBump<T> {
        const T up = layer.origin == TextureOrigin::upper_left ? T(-1) : T(1);
        const auto st = [&](Vec<T> p) {
            const Vec2<T> c = plane(p) * (1 / T(layer.tile));
            return Vec2<T>{c.x, c.y * up};
        };
        const TexCoord<T> at = linear_coordinates(st, s.position, s.d);
        if (content == Content::object_normal) {
            const Columns3<T> m = placement_matrix<T>(layer.transform);
            const auto row = [](T a, T b, T c) { return std::array{double(a), double(b), double(c)}; };
            const Vec<T> v =
                transform_normal({row(m.x.x, m.y.x, m.z.x), row(m.x.y, m.y.y, m.z.y), row(m.x.z, m.y.z, m.z.z)},
                                 texture.vector(at, footprint));
            if (is_zero(v)) return {};
            // Limited as slopes of normal maps are, or a plane with hardly any weight could outweigh the others.
            const Vec<T> g = surface_gradient_from_normal(s.normal, v);
            return {{}, g * std::min(T(1), T(128) / length(g))};
        }
        Vec2<T> d = texture.slope(at, footprint);
        if (layer.mode == TriplanarMode::geiss) {
            const Vec<T> normal = tangent_normal_from_slope(d);
            d = {-normal.x, -normal.y};
        }
        d = {d.x, d.y * up};
        if (content != Content::normal) return {d * (1 / T(layer.tile)), {}};
        // Slopes of normals have no unit, so a metre in the plane counts as a metre of the world.
        const auto metres = [&](Vec2<T> c) {
            const auto part = [&](Vec<T> axis) { return dot(Vec2<T>{c.x, c.y}, plane(axis) - plane(Vec<T>{})); };
            return length(Vec<T>{part({1, 0, 0}), part({0, 1, 0}), part({0, 0, 1})});
        };
        return {{d.x / metres({1, 0}), d.y / metres({0, 1})}, {}};
    };
}

/// A plane that shows noise: a slice of the noise in space, a third of a cell of the first octave above 0.
template <class T>
PlaneFunction<T> plane_of(const NoiseLayer& noise, const TriplanarLayer&, bool footprint, SceneTextures<T>&) {
    return [=, value = layer_noise<T>(noise), depth = 1 / (3 * T(noise.frequency))](
               const PlaneCoordinates<T>& plane, const Surfel<T>& s) -> PlaneBump<T> {
        const Vec2<T> at = plane(s.position), origin = plane(Vec<T>{});
        const auto size = [&](Vec<T> dp) {
            const Vec2<T> step = plane(dp) - origin;
            return std::sqrt(dot(step, step));
        };
        const T longest = footprint ? std::max(size(s.d.dp_dx), size(s.d.dp_dy)) : T(0);
        const Vec<T> g = value({at.x, at.y, depth}, longest).gradient;
        return {{g.x, g.y}, {}};
    };
}

/// [Mik20 4.4] The projection takes place in object space: points are taken there by the inverse of M and normals by
/// the transpose of M; gradients are taken back by the inverse transpose.
template <class T>
LayerFunction<T> make_layer(const TriplanarLayer& layer, bool footprint, SceneTextures<T>& textures) {
    std::array<PlaneFunction<T>, 3> planes;
    std::array<T, 3> scale{1, 1, 1};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto make = [&](const auto& source) { return plane_of<T>(source, layer, footprint, textures); };
        if (layer.planes[k]) scale[k] = T(layer.planes[k]->scale);
        planes[k] = layer.planes[k] ? std::visit(make, layer.planes[k]->content) : make(layer.texture);
    }
    return [=](const Surfel<T>& s) -> Contribution<T> {
        const Columns3<T> m = placement_matrix<T>(layer.transform);
        const T det = dot(m.x, cross(m.y, m.z));
        const T z_sign = layer.handedness == Handedness::right ? T(-1) : T(1);
        // Rows of the inverse, with the sign of z as it is sampled.
        const Vec<T> rows[] = {cross(m.y, m.z) / det, cross(m.z, m.x) / det, cross(m.x, m.y) * (z_sign / det)};
        Surfel<T> local = s;
        local.position = s.position - from_array<T>(layer.transform.translate);
        const Vec<T> weights = triplanar_weights(
            normalize(Vec<T>{dot(m.x, s.normal), dot(m.y, s.normal), dot(m.z, s.normal)}), T(layer.sharpness));
        const T w[] = {weights.x, weights.y, weights.z};
        Vec2<T> (*const order[])(Vec<T>) = {x_plane_st<T>, y_plane_st<T>, z_plane_st<T>};
        Contribution<T> sum;
        Vec2<T> slopes[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const PlaneCoordinates<T> plane = [&](Vec<T> v) {
                return order[k]({dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)});
            };
            const PlaneBump<T> bump = planes[k](plane, local);
            slopes[k] = bump.slope * scale[k];
            sum.surface = sum.surface + bump.surface * (w[k] * scale[k]);
        }
        const Vec<T> g = triplanar_volume_gradient(weights, slopes[0], slopes[1], slopes[2]);
        sum.volume = rows[0] * g.x + rows[1] * g.y + rows[2] * g.z;
        return sum;
    };
}

}  // namespace wrinkle::reference
