#include <utility>

#include "layers.h"
#include "noise.h"
#include "surface_gradient.h"
#include "wrinkle/error.h"

namespace wrinkle::baseline {

struct Evaluator::Prepared {
    Prepared(const Scene& scene_in, Size size_in, const Camera& camera_in)
        : scene(scene_in), size(size_in), camera(camera_terms(camera_in, size_in)) {}
    Scene scene;
    Size size;
    CameraTerms camera;
    std::vector<Stage> stages;
    std::vector<std::string> channels;
    bool aov_uv = false;
};

namespace {

/// Texture coordinates from the UV plane. They are computed when the first layer of a pixel asks for them.
struct AovUv {
    enum class State { unknown, found, missing } state = State::unknown;
    Uv uv;
};

/// What all pixels of a frame share, and where the current one is.
struct Place {
    const Frame& frame;
    const std::vector<Frame::Plane>& channels;
    UvDerivatives uv_kind;
    const RowWindow& window;
    int x, y;
    std::size_t i;
};

/// One pixel on its way through the stages. All functions are inlined into evaluate_row (gnu::flatten), so this lives
/// in registers: if they were called, storing and loading the float3 members would cost as much as the arithmetic.
struct Pixel {
    float3 p;                ///< relative to the eye
    float3 n, dp_dx, dp_dy;  ///< of the current stage
};

/// Sums of a stage. Listings 6 and 8 are linear, so they are applied once to a sum instead of once per layer: listing 8
/// to the volume gradients, listing 6 to the screen derivatives of the heights.
struct Sums {
    float3 surface, volume;
    float2 dh_dxy;
};

bool coordinates(const UvTransform& transform, const Place& at, const Pixel& px, AovUv& aov, Uv& out) {
    if (transform.planar) {
        out = transform.of_position(px.p, px.dp_dx, px.dp_dy);
        return true;
    }
    if (aov.state == AovUv::State::unknown) {
        const bool found = aov_uv(at.frame, at.uv_kind, at.window, at.x, at.y, aov.uv);
        aov.state = found ? AovUv::State::found : AovUv::State::missing;
    }
    out = transform.of_aov(aov.uv);
    return aov.state == AovUv::State::found;
}

float coverage(const Place& at, std::uint32_t id) {
    float sum = 0.0F;
    for (const auto& [ids, coverages] : at.frame.cryptomatte)
        if (std::bit_cast<std::uint32_t>(ids[at.i]) == id) sum += coverages[at.i];
    return sum;
}

float mask(const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov) {
    const PreparedMask& m = layer.mask;
    float value = 1.0F;
    if (m.object && at.frame.object[at.i] != *m.object) value = 0.0F;
    if (m.cryptomatte && value != 0.0F) value *= coverage(at, *m.cryptomatte);
    if (m.channel >= 0 && value != 0.0F) value *= clamp01(at.channels[static_cast<std::size_t>(m.channel)][at.i]);
    if (m.texture != nullptr && value != 0.0F) {
        Uv uv;
        if (!coordinates(m.uv, at, px, aov, uv)) return 0.0F;
        const auto& t = *m.texture;
        const float lod = layer.footprint ? footprint(uv.dst_dx, uv.dst_dy, t.width(), t.height(), t.top()).lod : 0.0F;
        value *= t.trilinear(uv.st, lod);
    }
    return m.invert ? 1.0F - value : value;
}

/// Scale times mask. Where it is 0, the layer does nothing.
float weight(const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov) {
    return layer.mask.any ? layer.scale * mask(layer, at, px, aov) : layer.scale;
}

void add(const NormalMap& map, const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov, Sums& sums) {
    const float k = weight(layer, at, px, aov);
    Uv uv;
    if (k == 0.0F || !coordinates(map.uv, at, px, aov, uv)) return;
    const float2 d = map.source.sample(uv, layer.footprint);
    sums.surface += k * surfgrad_from_tangent_derivative(d, px.n, px.dp_dx, px.dp_dy, uv.dst_dx, uv.dst_dy);
}

void add(const HeightMap& map, const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov, Sums& sums) {
    const float k = weight(layer, at, px, aov);
    Uv uv;
    if (k == 0.0F || !coordinates(map.uv, at, px, aov, uv)) return;
    const float2 dh_dst = k * map.source.sample(uv, layer.footprint);
    sums.dh_dxy = sums.dh_dxy + float2{dot(dh_dst, uv.dst_dx), dot(dh_dst, uv.dst_dy)};
}

void add(const Triplanar& map, const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov, Sums& sums) {
    const float k = weight(layer, at, px, aov);
    if (k == 0.0F) return;
    const float3 w = triplanar_weights(px.n, map.sharpness);
    const float3 p = map.per_tile * (px.p + at.frame.camera.eye);
    const float3 dx = map.per_tile * px.dp_dx, dy = map.per_tile * px.dp_dy;
    const auto plane = [&](float plane_weight, const Uv& uv) {
        return plane_weight > 0.0F ? map.source.sample(uv, layer.footprint) : float2{};
    };
    const float2 d_x = plane(w.x, {{p.z, p.y}, {dx.z, dx.y}, {dy.z, dy.y}});
    const float2 d_y = plane(w.y, {{p.x, p.z}, {dx.x, dx.z}, {dy.x, dy.z}});
    const float2 d_z = plane(w.z, {{p.x, p.y}, {dx.x, dx.y}, {dy.x, dy.y}});
    sums.volume += (k * map.slope_scale) * triplanar_volume_gradient(w, d_x, d_y, d_z);
}

/// A fractal sum. An octave fades with the weight by which its gradient comes closest to its mean over the pixel.
void add(const Noise& noise, const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov, Sums& sums) {
    const float k = weight(layer, at, px, aov);
    if (k == 0.0F) return;
    const float3 p = px.p + at.frame.camera.eye;
    const float pixel = layer.footprint ? std::sqrt(std::fmax(dot(px.dp_dx, px.dp_dx), dot(px.dp_dy, px.dp_dy))) : 0.0F;
    float3 gradient;
    for (const Noise::Octave& octave : noise.octaves) {
        const float cells = pixel * octave.frequency, side = 1.0F - 0.435F * cells * cells;
        if (side > 0.0F) gradient += (side * side * octave.amplitude) * perlin_noise(octave.frequency * p).gradient;
    }
    sums.volume += k * gradient;
}

/// Listing 15. Most pixels leave at one of the three box tests.
void add(const Decal& decal, const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov, Sums& sums) {
    const float qx = dot(decal.to_x, px.p) - decal.centre.x;
    if (std::abs(qx) > 1.0F) return;
    const float qy = dot(decal.to_y, px.p) - decal.centre.y;
    if (std::abs(qy) > 1.0F) return;
    const float qz = dot(decal.to_z, px.p) - decal.centre.z;
    if (std::abs(qz) > 1.0F) return;
    const float facing_z = dot(px.n, decal.axis_z) - decal.fade_from;
    float w = decal.per_fade > 0.0F ? clamp01(facing_z * decal.per_fade) : (facing_z >= 0.0F ? 1.0F : 0.0F);
    if (decal.per_falloff > 0.0F) {
        const auto edge = [&](float q) { return std::fmin((1.0F - std::abs(q)) * decal.per_falloff, 1.0F); };
        w *= edge(qx) * edge(qy) * edge(qz);
    }
    if (w == 0.0F) return;
    const float k = w * weight(layer, at, px, aov);
    if (k == 0.0F) return;
    const Uv uv{{0.5F * qx + 0.5F, 0.5F * qy + 0.5F},
                {0.5F * dot(decal.to_x, px.dp_dx), 0.5F * dot(decal.to_y, px.dp_dx)},
                {0.5F * dot(decal.to_x, px.dp_dy), 0.5F * dot(decal.to_y, px.dp_dy)}};
    const float2 d = decal.source.sample(uv, layer.footprint);
    sums.volume += (k * d.x) * decal.grad_s + (k * d.y) * decal.grad_t;
}

void add(const Constant& constant, const PreparedLayer& layer, const Place& at, const Pixel& px, AovUv& aov,
         Sums& sums) {
    sums.volume += weight(layer, at, px, aov) * constant.gradient;
}

float3 surface_gradient(const Stage& stage, const Place& at, const Pixel& px, AovUv& aov) {
    Sums sums;
    for (const PreparedLayer& layer : stage.layers)
        std::visit([&](const auto& bump) { add(bump, layer, at, px, aov, sums); }, layer.bump);
    float3 g = sums.surface + surfgrad_from_volume_gradient(px.n, sums.volume);
    if (sums.dh_dxy.x != 0.0F || sums.dh_dxy.y != 0.0F)
        g += surfgrad_scale_dependent(sums.dh_dxy, px.n, px.dp_dx, px.dp_dy);
    return g;
}

float3 evaluate(const std::vector<Stage>& stages, const Place& at, float3 p, float3 n) {
    Pixel px{p, n, {}, {}};
    AovUv aov;
    bool first = true;
    for (const Stage& stage : stages) {
        if (!first) px.n = facing(px.n, px.p);
        first = false;
        if (stage.screen_derivatives) {
            const ScreenDerivatives d = at.frame.screen_derivatives_at(at.x, at.y, px.p, px.n);
            px.dp_dx = d.dp_dx;
            px.dp_dy = d.dp_dy;
        }
        px.n = resolve_normal(px.n, surface_gradient(stage, at, px, aov));
    }
    return px.n;
}

[[gnu::flatten]] void evaluate_row(const std::vector<Stage>& stages, Place place, const Planes& out) {
    const bool neighbours = place.uv_kind == UvDerivatives::neighbours;
    for (int x = 0; x < place.frame.width; ++x) {
        const std::size_t i = place.frame.index(x, place.y);
        place.x = x;
        place.i = i;
        const Decoded decoded = neighbours ? place.window.at(x, place.y) : place.frame.decode(x, place.y);
        float3 n = at(place.frame.normal, i);
        if (decoded.valid) {
            n = evaluate(stages, place, decoded.p, decoded.n);
        } else if (!finite(n)) {
            n = {};
        }
        out.x[i] = n.x;
        out.y[i] = n.y;
        out.z[i] = n.z;
    }
}

void require_mask_planes(const std::vector<Stage>& stages, const Frame& frame) {
    for (const Stage& stage : stages) {
        for (const PreparedLayer& layer : stage.layers) {
            if (layer.mask.object && frame.object == nullptr)
                throw Error("baseline: a mask names an object index, but there is no plane object");
            if (layer.mask.cryptomatte && frame.cryptomatte.empty())
                throw Error(
                    "baseline: a mask names a cryptomatte object, but there are no planes crypto.id0 .coverage0");
        }
    }
}

}  // namespace

Evaluator::Evaluator(const Scene& scene, Size size, const Camera& camera,
                     const std::map<std::filesystem::path, Image>& textures,
                     const std::map<std::string, std::uint32_t>& cryptomatte) {
    auto prepared = std::make_unique<Prepared>(scene, size, camera);
    LayerBuilder builder(prepared->camera, textures, cryptomatte);
    prepared->stages = builder.stages(scene);
    prepared->channels = builder.channels;
    prepared->aov_uv = builder.aov_uv;
    prepared_ = std::move(prepared);
}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

void Evaluator::run(const PlaneMap& planes, std::span<float> nx, std::span<float> ny, std::span<float> nz) const {
    const Frame frame(prepared_->scene, prepared_->size, prepared_->camera, planes);
    const std::size_t count = static_cast<std::size_t>(frame.width) * frame.height;
    if (nx.size() != count || ny.size() != count || nz.size() != count)
        throw Error("baseline: an output plane is not of the frame's size");
    require_mask_planes(prepared_->stages, frame);
    std::vector<Frame::Plane> channels;
    for (const std::string& name : prepared_->channels) channels.push_back(frame.channel(name));
    const UvDerivatives uv_kind = prepared_->aov_uv ? uv_derivatives(frame) : UvDerivatives::planes;
    const bool neighbours = uv_kind == UvDerivatives::neighbours;

#pragma omp parallel
    {
        RowWindow window(frame);
#pragma omp for schedule(dynamic, 8)
        for (int y = 0; y < frame.height; ++y) {
            if (neighbours) window.move_to(y);
            evaluate_row(prepared_->stages, {frame, channels, uv_kind, window, 0, y, 0}, {nx, ny, nz});
        }
    }
}

}  // namespace wrinkle::baseline
