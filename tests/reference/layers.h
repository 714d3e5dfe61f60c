#pragma once

#include <functional>

#include "tests/reference/decal.h"
#include "tests/reference/fractal.h"
#include "tests/reference/projector.h"
#include "tests/reference/scale_dependent.h"
#include "tests/reference/tbn.h"
#include "tests/reference/texcoord.h"
#include "tests/reference/triplanar.h"

namespace wrinkle::reference {

/// What a layer adds: gradients already tangent to n, and volume gradients still to be projected onto n.
template <class T>
struct Contribution {
    Vec<T> surface, volume;
    bool usable = true;  ///< false: the UV plane has no derivative here; the contribution is zero
};

/// A layer without scale, blend and mask, ready to be asked at any surfel.
template <class T>
using LayerFunction = std::function<Contribution<T>(const Surfel<T>&)>;

template <class T>
LayerFunction<T> make_layer(const NormalMapLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, Content::normal)](const Surfel<T>& s) -> Contribution<T> {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return {{}, {}, false};
        const TangentFrame<T> frame = tangent_frame(s.normal, s.d.dp_dx, s.d.dp_dy, at->d);
        if (frame.degenerate) return {};
        return {surface_gradient_from_tbn(texture.slope(*at, footprint), frame.tangent, frame.bitangent), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const HeightMapLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, Content::height)](const Surfel<T>& s) -> Contribution<T> {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return {{}, {}, false};
        const Vec2<T> dh_dst = texture.slope(*at, footprint);
        return {surface_gradient_scale_dependent(s.normal, s.d.dp_dx, s.d.dp_dy, at->d, dh_dst), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const TriplanarLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, layer.texture.content)](const Surfel<T>& s) -> Contribution<T> {
        const T per_metre = texture.content == Content::height ? 1 / T(layer.tile) : T(1);
        const auto slope = [&](Vec2<T> (*plane)(Vec<T>)) {
            const auto st = [&](Vec<T> p) { return plane(p) * (1 / T(layer.tile)); };
            return texture.slope(linear_coordinates(st, s.position, s.d), footprint) * per_metre;
        };
        const Vec<T> weights = triplanar_weights(s.normal, T(layer.sharpness));
        return {{},
                triplanar_volume_gradient(weights, slope(x_plane_st<T>), slope(y_plane_st<T>), slope(z_plane_st<T>))};
    };
}

template <class T>
LayerFunction<T> make_layer(const NoiseLayer& layer, bool footprint, SceneTextures<T>&) {
    const Fractal<T> fractal{T(layer.frequency), layer.octaves, T(layer.lacunarity), T(layer.gain)};
    return [=](const Surfel<T>& s) -> Contribution<T> {
        const T longest = footprint ? std::max(length(s.d.dp_dx), length(s.d.dp_dy)) : T(0);
        return {{}, fractal_sum(fractal, s.position, longest).gradient};
    };
}

template <class T>
LayerFunction<T> make_layer(const DecalLayer& layer, bool footprint, SceneTextures<T>& textures) {
    TextureUse use = layer.texture;
    use.wrap = Wrap::clamp;
    const DecalBox<T> box = decal_box(from_array<T>(layer.center), from_array<T>(layer.axis_x),
                                      from_array<T>(layer.axis_y), from_array<T>(layer.half_size));
    return [=, texture = textures.slopes(use, use.content)](const Surfel<T>& s) -> Contribution<T> {
        const T weight = decal_box_weight(decal_coordinates(box, s.position - box.center), T(layer.falloff)) *
                         decal_angle_fade(dot(s.normal, box.z), T(layer.angle_fade[0]), T(layer.angle_fade[1]));
        if (weight == 0) return {};
        const auto st = [&](Vec<T> offset) {
            const Vec<T> q = decal_coordinates(box, offset);
            return Vec2<T>{q.x / 2, q.y / 2};
        };
        TexCoord<T> at = linear_coordinates(st, s.position - box.center, s.d);
        at.st = at.st + Vec2<T>{T(1) / 2, T(1) / 2};
        Vec2<T> d = texture.slope(at, footprint);
        if (texture.content == Content::height) d = {d.x / (2 * box.half_size.x), d.y / (2 * box.half_size.y)};
        return {{}, decal_volume_gradient(d, box.x, box.y) * weight};
    };
}

/// Every row at every point, in order: by priority where any row replaces, else as they come. Cryptomatte masks of rows
/// are not known here.
template <class T>
LayerFunction<T> make_layer(const DecalsLayer& layer, bool footprint, SceneTextures<T>& textures) {
    struct Entry {
        Projector row;
        LayerTexture<T> texture;
    };
    std::vector<Entry> entries;
    for (const Projector& row : *layer.rows) {
        TextureUse use = layer.textures.at(row.texture);
        use.wrap = row.wrap;
        entries.push_back({row, textures.slopes(use, use.content, row.region)});
    }
    std::ranges::stable_sort(entries, {}, [](const Entry& e) { return e.row.priority; });
    return [=](const Surfel<T>& s) -> Contribution<T> {
        Vec<T> sum;
        for (const Entry& e : entries) {
            if (e.row.object && s.object != *e.row.object) continue;
            add_projector(e.row, e.texture, s, footprint, sum);
        }
        return {{}, sum};
    };
}

template <class T>
LayerFunction<T> make_layer(const ConstantLayer& layer, bool, SceneTextures<T>&) {
    return [g = from_array<T>(layer.gradient)](const Surfel<T>&) -> Contribution<T> { return {{}, g}; };
}

template <class T>
LayerFunction<T> make_layer(const ResolveLayer&, bool, SceneTextures<T>&) {
    return {};
}

}  // namespace wrinkle::reference
