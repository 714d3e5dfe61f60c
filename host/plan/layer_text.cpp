#include "plan/layer_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace wrinkle {

TexelKind texel_kind(const TextureUse& use) {
    if (use.content == Content::object_normal) return TexelKind::vector;
    return use.content == Content::height && use.upscale == Upscale::plain ? TexelKind::height : TexelKind::slope;
}

double sample_cost(const TextureUse& use) {
    constexpr double kSlopeSample = 46, kHeightSamples = 150, kVectorSample = 58;
    const TexelKind kind = texel_kind(use);
    return kind == TexelKind::height ? kHeightSamples : kind == TexelKind::vector ? kVectorSample : kSlopeSample;
}

std::string sample_text(const TextureUse& use, const std::string& st, const std::string& lod,
                        const std::string& wanted) {
    const TexelKind kind = texel_kind(use);
    const char* form = kind == TexelKind::height   ? "wr_height_slope_plain"
                       : kind == TexelKind::vector ? "wr_object_normal"
                                                   : "wr_slope";
    return fmt::format("{}{}(t, {}, {}{})", form, use.wrap == Wrap::clamp ? "_clamp" : "", st, lod,
                       kind == TexelKind::slope && !wanted.empty() ? ", " + wanted : "");
}

std::string LayerText::strength() { return number("scale", signed_scale); }

const char* LayerText::exactly() const { return emitter.precision(layer) == Precision::exact ? "_exact" : ""; }

std::string LayerText::lod(const std::string& dx, const std::string& dy) const {
    return layer.footprint ? fmt::format("wr_texture_lod(t, {}, {})", dx, dy) : "(wr_real)(0)";
}

std::string LayerText::located(const TextureUse& use, TexelKind kind) {
    std::string text = emit_texcoord(emitter, layer, own_uv, use.wrap, who, section);
    if (own_uv(layer).source == UvSource::aov) text += "        m = uv_valid ? m : (wr_real)(0);\n";
    return text +
           fmt::format("        wr_texture t = wr_texture_at(texels, textures, {});\n", emitter.texture(use, kind));
}

std::string LayerText::textured(const TextureUse& use, const char* declared) {
    const std::string text = located(use, texel_kind(use)) +
                             fmt::format("        {} = {};\n", declared, sample_text(use, "c.st", lod("c.dx", "c.dy")));
    section.reads.insert({"n", "dp_dx", "dp_dy", "g"});
    section.writes.insert("g");
    section.operations += sample_cost(use);
    return text;
}

std::string LayerText::slopes(const std::string& function, const std::string& arguments) {
    constexpr double kSlopes = 60, kExactSlopes = 150;
    section.reads.insert({"n", "dp_dx", "dp_dy", "g"});
    section.writes.insert("g");
    section.operations += *exactly() ? kExactSlopes : kSlopes;
    return fmt::format(
        "        wr_vec3 bump = wr_surface_gradient_{}{}(n, dp_dx, dp_dy, {});\n"
        "        g = wr_fma(bump, m * {}, g);\n",
        function, exactly(), arguments, strength());
}

std::string LayerText::volume(const std::string& gradient) {
    const char* sum = layer.project ? "dh_dp" : "g";
    section.reads.insert(sum);
    section.writes.insert(sum);
    return fmt::format("        {0} = wr_fma({1}, m * {2}, {0});\n", sum, gradient, strength());
}

const UvMapping* find_uv(const Layer& layer) {
    return std::visit(
        [](const auto& bump) -> const UvMapping* {
            if constexpr (requires { bump.uv.has_value(); })
                return bump.uv ? &*bump.uv : nullptr;
            else if constexpr (requires { bump.uv; })
                return &bump.uv;
            else
                return nullptr;
        },
        layer.bump);
}

MovedPoints moved_points(Emitter& emitter, const std::string& indent) {
    const std::vector<Layer>& layers = emitter.scene.layers;
    const auto binned = [&](const Layer& layer) { return emitter.kind(layer).binned; };
    const auto last = std::find_if(layers.rbegin(), layers.rend(), binned).base();
    MovedPoints moved;
    bool own_normal = true;  // n is still the base normal
    for (auto layer = layers.begin(); layer != last; ++layer) {
        const LayerKind& kind = emitter.kind(*layer);
        if (kind.ends_stage) own_normal = false;
        if (!kind.moves) continue;
        const MovedPoint point = kind.moves(emitter, *layer, own_normal);
        moved.text += fmt::format("{0}nearer += {1};\n{0}farther += {2};\n", indent, point.nearer, point.farther);
        moved.by_normal |= point.by_normal;
        own_normal &= !point.turns;
    }
    return moved;
}

}  // namespace wrinkle
