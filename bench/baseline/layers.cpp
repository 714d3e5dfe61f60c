#include "layers.h"

#include <charconv>

#include "vec_double.h"
#include "wrinkle/error.h"

namespace wrinkle::baseline {
namespace {

std::uint32_t cryptomatte_id(const std::string& name, const std::map<std::string, std::uint32_t>& known) {
    if (name.starts_with('#')) {
        std::uint32_t id = 0;
        const char* end = name.data() + name.size();
        const auto [stop, failure] = std::from_chars(name.data() + 1, end, id, 16);
        if (failure != std::errc{} || stop != end)
            throw Error("baseline: cryptomatte = \"" + name + "\" is not # and 8 hex digits");
        return id;
    }
    const auto found = known.find(name);
    if (found == known.end()) throw Error("baseline: no cryptomatte hash was given for " + name);
    return found->second;
}

}  // namespace

std::vector<Stage> LayerBuilder::stages(const Scene& scene) {
    std::vector<Stage> out(1);
    for (const Layer& in : scene.layers) {
        if (std::holds_alternative<ResolveLayer>(in.bump)) {
            out.emplace_back();
            continue;
        }
        Stage& stage = out.back();
        stage.layers.push_back(layer(in));
        if (!std::holds_alternative<ConstantLayer>(in.bump) || in.mask.texture) stage.screen_derivatives = true;
    }
    return out;
}

PreparedLayer LayerBuilder::layer(const Layer& in) {
    PreparedLayer out;
    out.scale = static_cast<float>(in.blend == Blend::subtract ? -in.scale : in.scale);
    out.footprint = in.footprint;
    out.mask = mask(in.mask);
    std::visit(
        [&](const auto& kind) {
            if constexpr (requires { out.bump = bump(kind); })
                out.bump = bump(kind);
            else
                throw Unsupported("the plain C++ has no layers of kind " + std::string(kind.kind));
        },
        in.bump);
    return out;
}

PreparedMask LayerBuilder::mask(const Mask& in) {
    PreparedMask out;
    if (in.object.size() > 1 || in.cryptomatte.size() > 1)
        throw Unsupported("the plain C++ has no masks of several objects");
    out.any = !in.object.empty() || !in.cryptomatte.empty() || in.channel || in.texture || in.invert;
    out.invert = in.invert;
    if (!in.object.empty()) out.object = static_cast<float>(in.object.front());
    if (!in.cryptomatte.empty()) out.cryptomatte = cryptomatte_id(in.cryptomatte.front(), cryptomatte_);
    if (in.channel) {
        out.channel = static_cast<int>(channels.size());
        channels.push_back(*in.channel);
    }
    if (in.texture) {
        out.texture = scalars(in.texture->file, Wrap::repeat);
        out.uv = uv(in.texture->uv);
    }
    return out;
}

NormalMap LayerBuilder::bump(const NormalMapLayer& in) {
    TextureUse use = in.texture;
    use.content = Content::normal;
    return {source(use, use.wrap), uv(in.uv)};
}

HeightMap LayerBuilder::bump(const HeightMapLayer& in) {
    TextureUse use = in.texture;
    use.content = Content::height;
    return {source(use, use.wrap), uv(in.uv)};
}

Triplanar LayerBuilder::bump(const TriplanarLayer& in) {
    const bool own = in.planes[0] || in.planes[1] || in.planes[2];
    const bool known = in.texture.content == Content::height || in.texture.content == Content::normal;
    if (own || !known || in.transform != Placement{} || in.mode != TriplanarMode::surface_gradient ||
        in.origin != TextureOrigin::lower_left || in.handedness != Handedness::left)
        throw Unsupported("the plain C++ projects one texture of heights or normals along the axes of the world");
    const auto per_tile = static_cast<float>(1 / in.tile);
    return {source(in.texture, in.texture.wrap), per_tile, in.texture.content == Content::height ? per_tile : 1.0F,
            static_cast<float>(in.sharpness)};
}

Noise LayerBuilder::bump(const NoiseLayer& in) {
    const NoiseShape& shape = in.shape;
    if (in.type != NoiseType::perlin || in.fractal != FractalKind::sum || in.gradient != NoiseGradient::analytic ||
        shape.remap || shape.power || shape.smoothstep || shape.bias)
        throw Unsupported("the plain C++ has sums of Perlin noise only");
    Noise out;
    double frequency = in.frequency, gain = 1;
    for (int i = 0; i < in.octaves; ++i, frequency *= in.lacunarity, gain *= in.gain)
        out.octaves.push_back({static_cast<float>(frequency), static_cast<float>(gain * frequency)});
    return out;
}

Decal LayerBuilder::bump(const DecalLayer& in) {
    if (in.mode != DecalMode::surface_gradient) throw Unsupported("the plain C++ bumps the surface's normal only");
    const Vec3 x = unit(in.axis_x), z = unit(cross(x, in.axis_y)), y = cross(z, x);
    const Vec3 eye{camera_.eye.x, camera_.eye.y, camera_.eye.z};
    const Vec3 c{in.center[0] - eye[0], in.center[1] - eye[1], in.center[2] - eye[2]};
    const Vec3& h = in.half_size;
    Decal out;
    out.source = source(in.texture, Wrap::clamp);
    out.to_x = to_float3(scaled(x, 1 / h[0]));
    out.to_y = to_float3(scaled(y, 1 / h[1]));
    out.to_z = to_float3(scaled(z, 1 / h[2]));
    out.centre = to_float3({dot(x, c) / h[0], dot(y, c) / h[1], dot(z, c) / h[2]});
    out.axis_z = to_float3(z);
    const bool height = in.texture.content == Content::height;  // slopes are per unit s, t: 2 h metres
    out.grad_s = to_float3(height ? scaled(x, 0.5 / h[0]) : x);
    out.grad_t = to_float3(height ? scaled(y, 0.5 / h[1]) : y);
    out.per_falloff = in.falloff > 0 ? static_cast<float>(1 / in.falloff) : 0.0F;
    out.fade_from = static_cast<float>(in.angle_fade[0]);
    const double fade = in.angle_fade[1] - in.angle_fade[0];
    out.per_fade = fade > 0 ? static_cast<float>(1 / fade) : 0.0F;
    return out;
}

UvTransform LayerBuilder::uv(const UvMapping& mapping) {
    if (mapping.source == UvSource::aov) aov_uv = true;
    return {mapping, camera_};
}

SlopeSource LayerBuilder::source(const TextureUse& use, Wrap wrap) {
    if (use.upscale == Upscale::taps) throw Unsupported("the plain C++ takes no taps of heights");
    if (use.content == Content::height && use.upscale == Upscale::plain) return {nullptr, scalars(use.file, wrap)};
    const bool flip = use.content == Content::normal && use.y_down;
    Slopes& cached = slope_cache_[{use.file, use.content, wrap, flip}];
    if (cached == nullptr) {
        cached = std::make_shared<const Pyramid<float2>>(use.content == Content::height
                                                             ? height_slope_pyramid(image(use.file), wrap)
                                                             : normal_slope_pyramid(image(use.file), wrap, flip));
    }
    return {cached, nullptr};
}

Scalars LayerBuilder::scalars(const std::filesystem::path& file, Wrap wrap) {
    Scalars& cached = scalar_cache_[{file, wrap}];
    if (cached == nullptr) cached = std::make_shared<const Pyramid<float>>(scalar_pyramid(image(file), wrap));
    return cached;
}

const Image& LayerBuilder::image(const std::filesystem::path& file) const {
    const auto found = textures_.find(file);
    if (found == textures_.end()) throw Error("baseline: the texture " + file.string() + " was not given");
    return found->second;
}

}  // namespace wrinkle::baseline
