#include <fmt/format.h>

#include <cmath>

#include "plan/section.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Rough cost of kernel functions, operations per pixel; shown by `explain`, never used to decide anything.
constexpr double kSlopeSample = 46, kHeightSamples = 150, kFrame = 70, kScaleDependent = 85, kNoiseOctave = 260,
                 kDecal = 75, kTriplanar = 40;

TexelKind texel_kind(const TextureUse& use) {
    return use.content == Content::height && use.upscale == Upscale::plain ? TexelKind::height : TexelKind::slope;
}

double sample_cost(const TextureUse& use) {
    return texel_kind(use) == TexelKind::height ? kHeightSamples : kSlopeSample;
}

/// Name of the kernel function that samples the slopes of `use`.
std::string slope_function(const TextureUse& use) {
    const std::string form = texel_kind(use) == TexelKind::height ? "wr_height_slope_plain" : "wr_slope";
    return form + (use.wrap == Wrap::clamp ? "_clamp" : "");
}

std::string strength(const Layer& layer) {
    return literal(layer.blend == Blend::subtract ? -layer.scale : layer.scale);
}

struct Body {
    Emitter& emitter;
    const Layer& layer;
    const std::string who;
    Section& section;

    std::string lod(const std::string& dx, const std::string& dy) const {
        return layer.footprint ? fmt::format("wr_texture_lod(t, {}, {})", dx, dy) : "(real)(0)";
    }

    /// Opens the block of a source that samples one texture over a UV mapping.
    std::string textured(const TextureUse& use, const UvMapping& uv) {
        std::string text = emit_texcoord(emitter, uv, use.wrap, who, section);
        if (uv.source == UvSource::aov) text += "        m = uv_valid ? m : (real)(0);\n";
        text += fmt::format(
            "        wr_texture t = wr_texture_at(texels, textures, {});\n"
            "        vec2 slope = {}(t, c.st, {});\n",
            emitter.texture(use, texel_kind(use)), slope_function(use), lod("c.dx", "c.dy"));
        section.reads.insert({"n", "dp_dx", "dp_dy", "g"});
        section.writes.insert("g");
        section.operations += sample_cost(use);
        return text;
    }

    std::string volume(const std::string& gradient) {
        section.reads.insert("dh_dp");
        section.writes.insert("dh_dp");
        return fmt::format("        dh_dp = wr_fma({}, m * {}, dh_dp);\n", gradient, strength(layer));
    }

    std::string operator()(const NormalMapLayer& l) {
        std::string text = textured(l.texture, l.uv);
        section.operations += kFrame;
        return text + fmt::format(
                          "        wr_frame_tb f = wr_tangent_frame(n, dp_dx, dp_dy, c.dx, c.dy);\n"
                          "        g = wr_fma(wr_surface_gradient_from_tbn(slope, f), m * {}, g);\n",
                          strength(layer));
    }

    std::string operator()(const HeightMapLayer& l) {
        std::string text = textured(l.texture, l.uv);
        section.operations += kScaleDependent;
        return text +
               fmt::format(
                   "        vec3 bump = wr_surface_gradient_scale_dependent(n, dp_dx, dp_dy, c.dx, c.dy, slope);\n"
                   "        g = wr_fma(bump, m * {}, g);\n",
                   strength(layer));
    }

    std::string operator()(const TriplanarLayer& l) {
        const double per_metre = 1 / l.tile;
        const std::size_t origin = emitter.origin(
            {.axes = {Vec3{per_metre, 0, 0}, Vec3{0, per_metre, 0}, Vec3{0, 0, per_metre}}, .offset = {}, .period = 1});
        section.reads.insert({"p", "n", "dp_dx", "dp_dy"});
        section.operations += kTriplanar + 3 * sample_cost(l.texture);
        std::string text = fmt::format(
            "        wr_texture t = wr_texture_at(texels, textures, {});\n"
            "        vec3 q = wr_fma(p, (real)({}), wr_v3(origins + {}));\n"
            "        vec3 w = wr_triplanar_weights(n, {});\n"
            "        vec3 qx = wr_scale(dp_dx, (real)({})), qy = wr_scale(dp_dy, (real)({}));\n",
            emitter.texture(l.texture, texel_kind(l.texture)), literal(per_metre), 4 * origin, literal(l.sharpness),
            literal(per_metre), literal(per_metre));
        const struct {
            const char *weight, *s, *t, *name;
        } planes[] = {{"w.x", "z", "y", "slope_x"}, {"w.y", "x", "z", "slope_y"}, {"w.z", "x", "y", "slope_z"}};
        for (const auto& plane : planes)
            text += fmt::format(
                "        vec2 {3} = wr_v2((real)(0), (real)(0));\n"
                "        if (wr_any(active & ({0} > 0)))\n"
                "            {3} = {4}(t, wr_v2(q.{1}, q.{2}), {5});\n",
                plane.weight, plane.s, plane.t, plane.name, slope_function(l.texture),
                lod(fmt::format("wr_v2(qx.{}, qx.{})", plane.s, plane.t),
                    fmt::format("wr_v2(qy.{}, qy.{})", plane.s, plane.t)));
        if (l.texture.content == Content::height) text += fmt::format("        m *= {};\n", literal(per_metre));
        return text + volume("wr_triplanar_gradient(w, slope_x, slope_y, slope_z)");
    }

    std::string operator()(const NoiseLayer& l) {
        double frequency = l.frequency;
        std::size_t first = 0;
        for (int i = 0; i < l.octaves; ++i, frequency *= l.lacunarity) {
            const std::size_t origin =
                emitter.origin({.axes = {Vec3{frequency, 0, 0}, Vec3{0, frequency, 0}, Vec3{0, 0, frequency}},
                                .offset = {},
                                .period = 256,
                                .fourth = frequency});
            if (i == 0) first = origin;
        }
        section.reads.insert("p");
        if (layer.footprint) section.reads.insert({"dp_dx", "dp_dy"});
        section.operations += kNoiseOctave * l.octaves;
        return volume(fmt::format("wr_fractal_gradient(p, origins + {}, {}, {}, {}, active)", 4 * first,
                                  literal(l.gain), l.octaves,
                                  layer.footprint ? "wr_footprint_size(dp_dx, dp_dy)" : "(real)(0)"));
    }

    std::string operator()(const ConstantLayer& l) {
        section.operations += 6;
        return volume(literal(l.gradient));
    }

    std::string operator()(const DecalLayer&) { return {}; }
    std::string operator()(const ResolveLayer&) { return {}; }
};

/// Decals that may share a loop: same mask, same way to sample.
bool same_loop(const Layer& a, const Layer& b) {
    const auto plain = [](const Layer& l) {
        return !l.mask.object && !l.mask.cryptomatte && !l.mask.channel && !l.mask.texture && !l.mask.invert;
    };
    const bool same_mask =
        (plain(a) && plain(b)) || (!a.mask.texture && !b.mask.texture && a.mask.object == b.mask.object &&
                                   a.mask.cryptomatte == b.mask.cryptomatte && a.mask.channel == b.mask.channel &&
                                   a.mask.invert == b.mask.invert);
    const TextureUse &ta = std::get<DecalLayer>(a.bump).texture, &tb = std::get<DecalLayer>(b.bump).texture;
    return same_mask && a.footprint == b.footprint && slope_function(ta) == slope_function(tb);
}

std::string decal_loop(Emitter& emitter, const std::vector<const Layer*>& layers, Section& section) {
    const std::size_t first = emitter.plan.decals.size();
    for (const Layer* layer : layers) {
        const auto& decal = std::get<DecalLayer>(layer->bump);
        emitter.plan.decals.push_back(decal);
        emitter.plan.decal_scales.push_back(layer->blend == Blend::subtract ? -layer->scale : layer->scale);
        emitter.plan.decal_textures.push_back(emitter.texture(decal.texture, texel_kind(decal.texture)));
        section.operations += kDecal + sample_cost(decal.texture);
    }
    const Layer& layer = *layers.front();
    const bool facing = emitter.options.view_footprint;
    section.reads.insert({"p", "dh_dp"});
    section.writes.insert("dh_dp");
    if (!facing) section.reads.insert("n");
    if (layer.footprint) section.reads.insert({"dp_dx", "dp_dy"});
    return fmt::format(
        R"(        for (uint i = {}; i < {}; ++i) {{
            global const wr_decal *decal = decals + i;
            wr_decal_point in = wr_decal_locate(decal, p);
            if (!wr_any(active & in.inside)) continue;
            real weight = m * wr_decal_falloff(decal, in){};
            wr_texture t = wr_texture_at(texels, textures, (uint)decal->texture);
            vec2 slope = {}(t, in.st, {});
            dh_dp = wr_add(dh_dp, wr_decal_gradient(decal, slope, weight));
        }}
)",
        first, first + layers.size(), facing ? "" : " * wr_decal_angle_fade(decal, n)",
        slope_function(std::get<DecalLayer>(layer.bump).texture),
        layer.footprint ? "wr_texture_lod(t, wr_decal_step(decal, dp_dx), wr_decal_step(decal, dp_dy))" : "(real)(0)");
}

const char* kind_name(const Layer& layer) {
    static const char* const names[] = {"normal_map", "height_map", "triplanar", "noise",
                                        "decal",      "constant",   "resolve"};
    return names[layer.bump.index()];
}

}  // namespace

std::size_t layers_together(const std::vector<Layer>& layers, std::size_t first) {
    std::size_t count = 1;
    if (!std::holds_alternative<DecalLayer>(layers[first].bump)) return count;
    while (first + count < layers.size() && std::holds_alternative<DecalLayer>(layers[first + count].bump) &&
           same_loop(layers[first], layers[first + count]))
        ++count;
    return count;
}

Section emit_layers(Emitter& emitter, const std::vector<const Layer*>& layers) {
    const Layer& layer = *layers.front();
    Section section;
    section.title = fmt::format("{} \"{}\"", kind_name(layer), layer.name);
    if (layers.size() > 1) section.title += fmt::format(" and {} more", layers.size() - 1);
    const std::string who =
        fmt::format("{}layer \"{}\"", layer.location.empty() ? "" : layer.location + ": ", layer.name);
    for (const Layer* each : layers)
        if (!std::isfinite(each->scale))
            throw Error(fmt::format("layer \"{}\": scale is {}; it must be finite", each->name, each->scale));
    const std::string mask = emit_mask(emitter, layer, section);
    const std::string bump = std::holds_alternative<DecalLayer>(layer.bump)
                                 ? decal_loop(emitter, layers, section)
                                 : std::visit(Body{emitter, layer, who, section}, layer.bump);
    section.body = mask + "        if (wr_any(active)) {\n" + bump + "        }\n";
    return section;
}

}  // namespace wrinkle
