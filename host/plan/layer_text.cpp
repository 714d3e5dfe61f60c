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

std::size_t LayerText::matrix(const std::string& what, std::function<std::array<Vec3, 3>(const Layer&)> of) {
    return emitter.numbers(layer, what, [of = std::move(of)](const Layer& l, const NumberSource&) {
        std::vector<double> numbers;
        for (const Vec3& row : of(l)) numbers.insert(numbers.end(), row.begin(), row.end());
        return numbers;
    });
}

std::string LayerText::turned(const std::string& what, std::function<std::array<Vec3, 3>(const Layer&)> of) {
    const std::size_t rows = matrix(what, std::move(of));
    return fmt::format("        v = wr_turn(wr_v3(numbers + {}), wr_v3(numbers + {}), wr_v3(numbers + {}), v);\n", rows,
                       rows + 3, rows + 6);
}

std::string LayerText::strength() { return number("scale", signed_scale); }

const char* LayerText::exactly() const { return emitter.precision(layer) == Precision::exact ? "_exact" : ""; }

std::string LayerText::lod(const std::string& dx, const std::string& dy) const {
    if (!layer.footprint) return "(wr_real)(0)";
    // One point a pixel is the centre of its area, sampled as if areas were not walked at all.
    const bool several = over_area() && emitter.scene.filter.taps > 1;
    return fmt::format("{}(t, {}, {})", several ? "wr_area_lod" : "wr_filter_lod", dx, dy);
}

std::string LayerText::located(const TextureUse& use, TexelKind kind) {
    std::string text = emit_texcoord(emitter, layer, own_uv, use.wrap, who, section);
    if (own_uv(layer).source == UvSource::aov) text += "        m = uv_valid ? m : (wr_real)(0);\n";
    return text +
           fmt::format("        wr_texture t = wr_texture_at(texels, textures, {});\n", emitter.texture(use, kind));
}

bool LayerText::over_area() const { return varies_over_area(emitter, layer); }

bool LayerText::tells_spread() const { return wants_spread(emitter) && over_area(); }

std::string LayerText::spread(const std::string& along_s, const std::string& along_t) {
    if (!tells_spread()) return {};
    section.operations += 40;
    return fmt::format(
        "        finer = wr_add(finer, wr_spread_along(lost, m * {}, wr_on_axes({}, right, down), wr_on_axes({}, "
        "right, "
        "down)));\n",
        strength(), along_s, along_t);
}

std::string LayerText::once(const char* type, const char* name, const std::string& value) {
    if (!over_area()) return value;
    const std::string own = fmt::format("{}_{}", name, emitter.index_of(layer));
    declared += fmt::format("        {} {};\n", type, own);
    prepared += fmt::format("        {} = {};\n", own, value);
    return own;
}

std::string LayerText::textured(const TextureUse& use, const char* declared) {
    std::string text = located(use, texel_kind(use));
    if (over_area()) prepared += text;
    const std::string level = once("wr_real", "lod", lod("c.dx", "c.dy"));
    text += fmt::format("        {} = {};\n", declared, sample_text(use, "c.st", level));
    if (texel_kind(use) != TexelKind::vector && tells_spread()) {
        const char* wrap = use.wrap == Wrap::clamp ? "wr_clamp" : "wr_repeat";
        const std::string share = once("wr_real", "texel", "wr_texel_share(t, c.dx, c.dy)");
        section.operations += 20;
        loses = true;
        text += fmt::format(
            "        wr_vec3 lost = wr_scale(wr_lost_slopes(wr_texture_at(texels, textures, {0}), {1}(c.st.x), "
            "{1}(c.st.y), {2}), {3});\n",
            emitter.texture(use, TexelKind::lost_slopes), wrap, level, share);
    }
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
    std::string basis, text;
    const bool scaled = function == "scale_dependent" && over_area();
    const bool spreads = scaled && loses;
    if (scaled && (!*exactly() || spreads))
        basis = once("wr_slope_basis", "basis", "wr_slope_basis_of(n, dp_dx, dp_dy, c.dx, c.dy)");
    if (scaled && !*exactly())
        text =
            fmt::format("        g = wr_fma(wr_surface_gradient_on_basis({}, slope), m * {}, g);\n", basis, strength());
    else
        text = fmt::format(
            "        wr_vec3 bump = wr_surface_gradient_{}{}(n, dp_dx, dp_dy, {});\n"
            "        g = wr_fma(bump, m * {}, g);\n",
            function, exactly(), arguments, strength());
    return spreads ? text + spread(basis + ".s", basis + ".t") : text;
}

std::string LayerText::below() {
    section.reads.insert("g");
    if (!space) return "g";
    section.reads.insert("dh_dp");
    return "wr_add(g, wr_surface_gradient_from_volume(n, dh_dp))";
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
    const auto last =
        has_light_table(emitter) ? layers.end() : std::find_if(layers.rbegin(), layers.rend(), binned).base();
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
