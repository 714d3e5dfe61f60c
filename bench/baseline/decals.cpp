#include "decals.h"

#include <algorithm>

#include "frame.h"
#include "surface_gradient.h"
#include "texture.h"
#include "vec_double.h"
#include "wrinkle/error.h"

namespace wrinkle::baseline {

namespace {

struct Row {
    float3 to_x, to_y, to_z, centre;  ///< q.x = to_x . (p - centre)
    float3 axis_z;
    float strength_x, strength_y;
    float3 per_falloff;  ///< 1 / falloff; 0: hard edges
    float fade_from, per_fade;
    float2 repeat;
    float opacity;
    const Pyramid<float2>* slopes;
    ProjectorShape shape;
    bool two_sided, replace, per_size;
};

float edge(float distance, float per_falloff) {
    return per_falloff > 0.0F ? std::fmin((1.0F - distance) * per_falloff, 1.0F) : 1.0F;
}

/// Adds or mixes in one decal. Most pixels leave at one of the three box tests.
inline void add(const Row& d, float3 p, float3 n, float3 dp_dx, float3 dp_dy, float3& sum) {
    const float3 at = p - d.centre;
    const float3 q{dot(d.to_x, at), dot(d.to_y, at), dot(d.to_z, at)};
    if (std::abs(q.x) > 1.0F || std::abs(q.y) > 1.0F || std::abs(q.z) > 1.0F) return;
    float2 image{q.x, q.y};
    float size = 1.0F, weight;
    float3 axis_s = d.to_x, axis_t = d.to_y;
    if (d.shape == ProjectorShape::box) {
        weight = edge(std::abs(q.x), d.per_falloff.x) * edge(std::abs(q.y), d.per_falloff.y) *
                 edge(std::abs(q.z), d.per_falloff.z);
    } else if (d.shape == ProjectorShape::sphere) {
        const float r = std::sqrt(dot(q, q));
        if (r > 1.0F) return;
        weight = edge(r, d.per_falloff.x);
    } else {
        size = 0.5F - 0.5F * q.z;
        if (size < 1.0F / 64) return;
        image = (1.0F / size) * image;
        const float r = std::sqrt(dot(image, image));
        if (r > 1.0F) return;
        weight = edge(r, d.per_falloff.x) * edge(std::abs(q.z), d.per_falloff.z);
        axis_s = axis_s + (0.5F * image.x) * d.to_z;
        axis_t = axis_t + (0.5F * image.y) * d.to_z;
    }
    float facing = dot(n, d.axis_z);
    if (d.two_sided) facing = std::abs(facing);
    if (facing <= 0.0F) return;
    weight *= d.opacity * clamp01((facing - d.fade_from) * d.per_fade);
    if (weight == 0.0F) return;
    const float half = 0.5F / size;
    const float2 st{(0.5F * image.x + 0.5F) * d.repeat.x, (0.5F * image.y + 0.5F) * d.repeat.y};
    const float2 dx{half * d.repeat.x * dot(axis_s, dp_dx), half * d.repeat.y * dot(axis_t, dp_dx)};
    const float2 dy{half * d.repeat.x * dot(axis_s, dp_dy), half * d.repeat.y * dot(axis_t, dp_dy)};
    const Pyramid<float2>& t = *d.slopes;
    const float2 slope = t.trilinear(st, footprint(dx, dy, t.width(), t.height(), t.top()).lod);
    const float k = d.per_size ? weight / size : weight;
    const float3 g = (k * slope.x * d.strength_x) * axis_s + (k * slope.y * d.strength_y) * axis_t;
    sum = d.replace ? (1.0F - weight) * sum + g : sum + g;
}

}  // namespace

struct DecalTable::Prepared {
    Size size;
    CameraTerms camera;
    std::map<std::tuple<std::uint32_t, std::array<double, 4>, Wrap>, Pyramid<float2>> pyramids;
    std::vector<Row> rows;
};

namespace {

Image region_of(const Image& image, const std::array<double, 4>& region) {
    const auto texel = [](double at, int size) { return static_cast<int>(std::lround(at * size)); };
    const int left = texel(region[0], image.width), right = std::max(left + 1, texel(region[2], image.width));
    const int low = texel(region[1], image.height), high = std::max(low + 1, texel(region[3], image.height));
    Image out{right - left, high - low, image.channels, {}};
    for (int y = low; y < high; ++y)
        for (int i = left * image.channels; i < right * image.channels; ++i)
            out.texels.push_back(image.texels[static_cast<std::size_t>(y) * image.width * image.channels + i]);
    return out;
}

}  // namespace

DecalTable::DecalTable(const DecalsLayer& layer, double scale, Size size, const Camera& camera,
                       const std::map<std::filesystem::path, Image>& textures) {
    auto prepared = std::make_unique<Prepared>();
    prepared->size = size;
    prepared->camera = camera_terms(camera, size);
    const Vec3 eye = {prepared->camera.eye.x, prepared->camera.eye.y, prepared->camera.eye.z};
    for (const Projector& in : *layer.rows) {
        if (in.object || !in.cryptomatte.empty()) throw Error("baseline: decals with masks are not prepared here");
        const TextureUse& use = layer.textures.at(in.texture);
        if (use.content == Content::slope) throw Error("baseline: maps of slopes are not prepared here");
        auto& pyramids = prepared->pyramids;
        auto found = pyramids.find({in.texture, in.region, in.wrap});
        if (found == pyramids.end()) {
            const Image image = region_of(textures.at(use.file), in.region);
            found = pyramids
                        .emplace(std::tuple{in.texture, in.region, in.wrap},
                                 use.content == Content::height ? height_slope_pyramid(image, in.wrap)
                                                                : normal_slope_pyramid(image, in.wrap, use.y_down))
                        .first;
        }
        const Vec3 x = unit(in.axis_x), z = unit(cross(x, in.axis_y)), y = cross(z, x);
        const Vec3& h = in.half_size;
        const bool height = use.content == Content::height, tiles = in.wrap == Wrap::repeat;
        const double fade = std::max(in.angle_fade[1] - in.angle_fade[0], 1e-6);
        Row row;
        row.to_x = to_float3(scaled(x, 1 / h[0]));
        row.to_y = to_float3(scaled(y, 1 / h[1]));
        row.to_z = to_float3(scaled(z, 1 / h[2]));
        row.centre = to_float3({in.center[0] - eye[0], in.center[1] - eye[1], in.center[2] - eye[2]});
        row.axis_z = to_float3(z);
        row.repeat = tiles ? float2{static_cast<float>(in.repeat[0]), static_cast<float>(in.repeat[1])} : float2{1, 1};
        const double strength = scale * in.scale;
        row.strength_x = static_cast<float>(height ? strength / 2 * row.repeat.x : strength * h[0]);
        row.strength_y = static_cast<float>(height ? strength / 2 * row.repeat.y : strength * h[1]);
        const auto per = [](double share) { return share > 0 ? static_cast<float>(1 / share) : 0.0F; };
        row.per_falloff = {per(in.falloff[0]), per(in.falloff[1]), per(in.falloff[2])};
        row.fade_from = static_cast<float>(in.angle_fade[0]);
        row.per_fade = static_cast<float>(1 / fade);
        row.opacity = static_cast<float>(in.opacity);
        row.slopes = &found->second;
        row.shape = in.shape;
        row.two_sided = in.two_sided;
        row.replace = in.mode == ProjectorMode::replace;
        row.per_size = in.shape == ProjectorShape::cone && height;
        prepared->rows.push_back(row);
    }
    prepared_ = std::move(prepared);
}

DecalTable::~DecalTable() = default;

void DecalTable::run(const Scene& scene, const PlaneMap& planes, const TileLists& tiles, Planes out) const {
    const Frame frame(scene, prepared_->size, prepared_->camera, planes);
    const int across = (frame.width + tiles.tile_width - 1) / tiles.tile_width;
#pragma omp parallel for schedule(dynamic, 8)
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t i = frame.index(x, y);
            const Decoded decoded = frame.decode(x, y);
            float3 n = at(frame.normal, i);
            if (decoded.valid) {
                n = decoded.n;
                const ScreenDerivatives d = frame.screen_derivatives_at(x, y, decoded.p, n);
                float3 sum;
                for (const std::uint32_t k : tiles.lists[static_cast<std::size_t>(y / tiles.tile_height) * across +
                                                         static_cast<std::size_t>(x / tiles.tile_width)])
                    add(prepared_->rows[k], decoded.p, n, d.dp_dx, d.dp_dy, sum);
                n = resolve_normal(n, surfgrad_from_volume_gradient(n, sum));
            } else if (!finite(n)) {
                n = {};
            }
            out.x[i] = n.x;
            out.y[i] = n.y;
            out.z[i] = n.z;
        }
    }
}

}  // namespace wrinkle::baseline
