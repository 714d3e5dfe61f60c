#pragma once

#include <functional>

#include "io/volume_file.h"
#include "tests/reference/decal.h"
#include "tests/reference/fractal.h"
#include "tests/reference/height_taps.h"
#include "tests/reference/noise_means.h"
#include "tests/reference/normal_transform.h"
#include "tests/reference/parallax.h"
#include "tests/reference/perturbed_normal.h"
#include "tests/reference/projector.h"
#include "tests/reference/scale_dependent.h"
#include "tests/reference/shape.h"
#include "tests/reference/tbn.h"
#include "tests/reference/texcoord.h"
#include "tests/reference/texture_metres.h"
#include "tests/reference/user_kernel.h"
#include "tests/reference/volume_levels.h"

namespace wrinkle::reference {

/// What a layer adds: surface gradients, which are tangent to n, and volume gradients, which are projected later.
template <class T>
struct Contribution {
    Vec<T> surface, volume;
    bool usable = true;  ///< false when texture coordinates have no derivative here: the layer adds nothing
    bool marks = false;  ///< a neighbour was missing, and the pixel is marked
    /// In the mode "projector" of a decal: the axis that `volume` bumps instead of the surface's normal. Both are then
    /// mixed by the share that follows.
    std::optional<Vec<T>> axis{};
    T share = 0;
};

/// A layer without scale, blend and mask, as a function of a surfel.
template <class T>
using LayerFunction = std::function<Contribution<T>(const Surfel<T>&)>;

/// Whether a layer uses the renderer's tangents.
inline bool uses_vertex_frame(const NormalMapLayer& layer, bool planes) {
    const bool fits = layer.uv.source == UvSource::aov && layer.uv.rotation == 0;
    return planes && fits && layer.tangents != TangentSource::derived;
}

template <class T>
LayerFunction<T> make_layer(const NormalMapLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, Content::normal)](const Surfel<T>& s) -> Contribution<T> {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return {{}, {}, false};
        if (uses_vertex_frame(layer, s.vertex_planes)) {
            if (!s.vertex) return {{}, {}, false};
            const Vec2<T> d = texture.slope(*at, footprint);
            const auto mirror = [](double scale) { return scale < 0 ? T(-1) : T(1); };
            return {surface_gradient_from_tbn({d.x * mirror(layer.uv.scale[0]), d.y * mirror(layer.uv.scale[1])},
                                              s.vertex->tangent, s.vertex->bitangent),
                    {}};
        }
        const TangentFrame<T> frame = tangent_frame(s.normal, s.d.dp_dx, s.d.dp_dy, at->d);
        if (frame.degenerate || edge_on(layer.uv, s.normal)) return {};
        return {surface_gradient_from_tbn(texture.slope(*at, footprint), frame.tangent, frame.bitangent), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const HeightMapLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, Content::height)](const Surfel<T>& s) -> Contribution<T> {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return {{}, {}, false};
        if (layer.texture.upscale == Upscale::taps) {
            const T lod = texture.lod(at->d, footprint);
            const Vec2<T> dh = height_taps(*texture.pyramid, at->st, at->d, lod, texture.wrap);
            return {surface_gradient_from_screen_slope(s.normal, s.d.dp_dx, s.d.dp_dy, dh), {}};
        }
        const Vec2<T> dh_dst = texture.slope(*at, footprint);
        return {surface_gradient_scale_dependent(s.normal, s.d.dp_dx, s.d.dp_dy, at->d, dh_dst), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const HeightChannelLayer& layer, bool, SceneTextures<T>&) {
    return [name = "channel:" + layer.channel](const Surfel<T>& s) -> Contribution<T> {
        const auto dh = s.height_slope(name);
        if (!dh) return {{}, {}, false, true};
        return {surface_gradient_from_screen_slope(s.normal, s.d.dp_dx, s.d.dp_dy, *dh), {}};
    };
}

/// A layer's noise, with its fractal and its shape, at a point with a footprint of that length.
template <class T>
std::function<NoiseValue<T>(Vec<T> p, T longest)> layer_noise(const NoiseLayer& layer) {
    const Fractal<T> f{
        T(layer.frequency), layer.octaves,    T(layer.lacunarity), T(layer.gain), static_cast<Octaves>(layer.fractal),
        T(layer.offset),    T(layer.feedback)};
    return
        [=, noise = octave_noise<T>(layer), means = noise_means<T>(layer), shape = layer.shape](Vec<T> p, T longest) {
            NoiseValue<T> n = fractal<T>(f, noise, means, p, longest);
            if (shape.remap) n = shape_remap(n, T((*shape.remap)[0]), T((*shape.remap)[1]));
            if (shape.power) n = shape_power(n, T(*shape.power));
            if (shape.smoothstep) n = shape_smoothstep(n, T((*shape.smoothstep)[0]), T((*shape.smoothstep)[1]));
            if (shape.bias) n = shape_bias(n, T(*shape.bias));
            return n;
        };
}

template <class T>
LayerFunction<T> make_layer(const KernelLayer& layer, bool footprint, SceneTextures<T>&) {
    return [=, height = user_height(layer.function)](const Surfel<T>& s) -> Contribution<T> {
        const T longest = footprint ? std::max(length(s.d.dp_dx), length(s.d.dp_dy)) : T(0);
        const auto gradient = [&](T x, T y, T z) {
            const long double at[3] = {x, y, z};
            const Vec<long double> g = user_gradient(height, layer.parameters, at, longest);
            return Vec<T>{static_cast<T>(g.x), static_cast<T>(g.y), static_cast<T>(g.z)};
        };
        if (!layer.over_uv) return {{}, gradient(s.position.x, s.position.y, s.position.z)};
        const auto at = map_coordinates(layer.uv.value(), s);
        if (!at) return {{}, {}, false};
        const Vec<T> slope = gradient(at->st.x, at->st.y, T(0));
        return {surface_gradient_scale_dependent(s.normal, s.d.dp_dx, s.d.dp_dy, at->d, {slope.x, slope.y}), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const NoiseLayer& layer, bool footprint, SceneTextures<T>&) {
    return [=, noise = layer_noise<T>(layer)](const Surfel<T>& s) -> Contribution<T> {
        return {{}, noise(s.position, footprint ? std::max(length(s.d.dp_dx), length(s.d.dp_dy)) : T(0)).gradient};
    };
}

template <class T>
LayerFunction<T> make_layer(const DecalLayer& layer, bool footprint, SceneTextures<T>& textures) {
    TextureUse use = layer.texture;
    use.wrap = Wrap::clamp;
    const DecalBox<T> box = decal_box(from_array<T>(layer.center), from_array<T>(layer.axis_x),
                                      from_array<T>(layer.axis_y), from_array<T>(layer.half_size));
    return [=, texture = textures.slopes(use, use.content)](const Surfel<T>& s) -> Contribution<T> {
        const T along = dot(s.normal, box.z), facing = layer.two_sided ? std::abs(along) : along;
        const T weight = facing > 0
                             ? decal_box_weight(decal_coordinates(box, s.position - box.center), T(layer.falloff)) *
                                   decal_angle_fade(facing, T(layer.angle_fade[0]), T(layer.angle_fade[1]))
                             : T(0);
        if (weight == 0) return {};
        const auto st = [&](Vec<T> offset) {
            const Vec<T> q = decal_coordinates(box, offset);
            return Vec2<T>{q.x / 2, q.y / 2};
        };
        TexCoord<T> at = linear_coordinates(st, s.position - box.center, s.d);
        at.st = at.st + Vec2<T>{T(1) / 2, T(1) / 2};
        Vec2<T> d = texture.slope(at, footprint);
        if (texture.content == Content::height) d = {d.x / (2 * box.half_size.x), d.y / (2 * box.half_size.y)};
        const Vec<T> gradient = decal_volume_gradient(d, box.x, box.y);
        if (layer.mode == DecalMode::projector) return {{}, gradient, true, false, box.z, weight};
        return {{}, gradient * weight};
    };
}

/// A table of decals, by evaluating every row at every point: in the order of priority when any row replaces, else in
/// that of the table.
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
            const std::string& name = e.row.cryptomatte;
            const T seen = name.empty() ? T(1) : coverage_of_bumps(s.coverage(name), s.front, {name}, false);
            add_projector(e.row, e.texture, s, footprint, seen, sum);
        }
        return {{}, sum};
    };
}

template <class T>
LayerFunction<T> make_layer(const VolumeLayer& layer, bool footprint, SceneTextures<T>&) {
    const Volume volume = load_volume(layer.file, layer.grid);
    const Mat4 m = multiply(volume.info.index_from_world, inverse(layer.transform));
    const auto channels = std::make_shared<std::vector<VolumeMeans<T>>>();
    for (int c = 0; c < volume.info.channels; ++c) channels->emplace_back(volume, c);
    return [=](const Surfel<T>& s) -> Contribution<T> {
        const auto row = [&](int i) { return Vec<T>{T(m[i][0]), T(m[i][1]), T(m[i][2])}; };
        const auto turned = [&](Vec<T> v) { return Vec<T>{dot(row(0), v), dot(row(1), v), dot(row(2), v)}; };
        const Vec<T> q = turned(s.position) + Vec<T>{T(m[0][3]), T(m[1][3]), T(m[2][3])};
        const T longest = std::max(length(turned(s.d.dp_dx)), length(turned(s.d.dp_dy)));
        const T lod = footprint ? std::max(std::log2(std::max(longest, T(1))) - filter_finer<T>(), T(0)) : T(0);
        const auto at_point = [&](const Voxels<T>& voxel, Vec<T> at) {
            return layer.filter == VolumeFilter::smooth ? quadratic_spline(voxel, at) : trilinear(voxel, at);
        };
        const auto sampled = [&](std::size_t c) { return filtered_voxels<T>((*channels)[c], at_point, q, lod); };
        if (channels->size() == 3) return {{}, {sampled(0).value, sampled(1).value, sampled(2).value}};
        const NoiseValue<T> v = sampled(0);
        const Vec<T> dh_dp = row(0) * v.gradient.x + row(1) * v.gradient.y + row(2) * v.gradient.z;
        return {{}, dh_dp * remapped(layer.remap, v.value, T(layer.range[0]), T(layer.range[1])).y};
    };
}

template <class T>
LayerFunction<T> make_layer(const ConstantLayer& layer, bool, SceneTextures<T>&) {
    return [g = from_array<T>(layer.gradient)](const Surfel<T>&) -> Contribution<T> { return {{}, g}; };
}

/// Channels of the frame, in world space; those of other files are read before, and are no matter of an evaluation.
template <class T>
LayerFunction<T> make_layer(const GradientLayer& layer, bool, SceneTextures<T>&) {
    std::array<std::string, 3> planes;
    for (std::size_t k = 0; k < 3; ++k) planes[k] = "channel:" + layer.channels.at(k);
    return [planes](const Surfel<T>& s) -> Contribution<T> {
        const auto gradient = s.vector(planes);
        if (!gradient) return {{}, {}, false, true};
        return {{}, *gradient};
    };
}

template <class T>
LayerFunction<T> make_layer(const ObjectNormalLayer& layer, bool footprint, SceneTextures<T>& textures) {
    const auto channel = [&](int k) { return from_array<T>(layer.channels[k]); };
    return [=, texture = textures.slopes(layer.texture, Content::object_normal), red = channel(0), green = channel(1),
            blue = channel(2)](const Surfel<T>& s) -> Contribution<T> {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return {{}, {}, false};
        const Vec<T> texel = texture.vector(*at, footprint);
        const Vec<T> v = transform_normal(layer.object_to_world, red * texel.x + green * texel.y + blue * texel.z);
        if (is_zero(v)) return {};
        return {surface_gradient_from_normal(s.normal, v), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const DerivativeMapLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, Content::slope)](const Surfel<T>& s) -> Contribution<T> {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return {{}, {}, false};
        Vec2<T> dh_dst = texture.slope(*at, footprint);
        if (layer.auto_scale) {
            const Level<T>& top = texture.pyramid->levels.front();
            const T texels = layer.texture.unit == SlopeUnit::texel ? std::sqrt(T(top.width) * top.height) : T(1);
            dh_dst = dh_dst * (texture_metres(s.d.dp_dx, s.d.dp_dy, at->d) / texels);
        }
        return {surface_gradient_scale_dependent(s.normal, s.d.dp_dx, s.d.dp_dy, at->d, dh_dst), {}};
    };
}

template <class T>
LayerFunction<T> make_layer(const ParallaxLayer&, bool, SceneTextures<T>&) {
    return [](const Surfel<T>&) -> Contribution<T> { return {}; };
}

/// How far a layer moves a surfel towards the viewer, in metres along the ray. `view` is the unit vector to the viewer,
/// who is `distance` away; `depth` is the metres for a height of 1.
template <class T>
using ShiftFunction = std::function<T(const Surfel<T>&, Vec<T> view, T distance, T depth)>;

/// Layers of other kinds than parallax move nothing.
template <class T, class Bump>
ShiftFunction<T> make_shift(const Bump&, bool, SceneTextures<T>&) {
    return {};
}

template <class T>
ShiftFunction<T> make_shift(const ParallaxLayer& layer, bool footprint, SceneTextures<T>& textures) {
    return [=, texture = textures.slopes(layer.texture, Content::height)](const Surfel<T>& s, Vec<T> view, T distance,
                                                                          T depth) -> T {
        const auto at = map_coordinates(layer.uv, s);
        if (!at) return 0;
        const auto height = [&](Vec2<T> st) {
            return sample(*texture.pyramid, 0, st, texture.lod(at->d, footprint), texture.wrap);
        };
        const T level = layer.level;
        T reach = layer.mode == ParallaxMode::offset ? depth : depth / std::max(dot(s.normal, view), T(0.05L));
        reach = std::min(reach, level < 1 ? distance / (2 * (1 - level)) : distance * T(1e6L));
        const auto pixels = screen_vector(s.normal, s.d.dp_dx, s.d.dp_dy, view);
        if (!pixels) return 0;
        if (footprint) reach *= saturate(std::hypot(pixels->x, pixels->y) * reach / T(0.5L) - 1);
        if (!(reach > 0)) return 0;
        if (layer.mode == ParallaxMode::offset) return reach * (saturate(height(at->st)) - level);
        const Vec2<T> range = project_to_texture(s.normal, s.d.dp_dx, s.d.dp_dy, at->d, view, false) * reach;
        const T step = parallax_step(texture.pyramid->levels[0], range, texture.lod(at->d, footprint), layer.steps);
        return reach * (parallax_march(height, at->st, range, level, step, layer.steps, layer.refine) - level);
    };
}

template <class T>
LayerFunction<T> make_layer(const ResolveLayer&, bool, SceneTextures<T>&) {
    return {};
}

}  // namespace wrinkle::reference
