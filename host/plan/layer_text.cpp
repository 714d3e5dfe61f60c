#include "plan/layer_text.h"

#include <fmt/format.h>

namespace wrinkle {

TexelKind texel_kind(const TextureUse& use) {
    return use.content == Content::height && use.upscale == Upscale::plain ? TexelKind::height : TexelKind::slope;
}

double sample_cost(const TextureUse& use) {
    constexpr double kSlopeSample = 46, kHeightSamples = 150;
    return texel_kind(use) == TexelKind::height ? kHeightSamples : kSlopeSample;
}

std::string slope_function(const TextureUse& use) {
    const std::string form = texel_kind(use) == TexelKind::height ? "wr_height_slope_plain" : "wr_slope";
    return form + (use.wrap == Wrap::clamp ? "_clamp" : "");
}

std::string LayerText::strength() const { return literal(layer.blend == Blend::subtract ? -layer.scale : layer.scale); }

std::string LayerText::lod(const std::string& dx, const std::string& dy) const {
    return layer.footprint ? fmt::format("wr_texture_lod(t, {}, {})", dx, dy) : "(real)(0)";
}

std::string LayerText::textured(const TextureUse& use, const UvMapping& uv) {
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

std::string LayerText::volume(const std::string& gradient) {
    const char* sum = layer.project ? "dh_dp" : "g";
    section.reads.insert(sum);
    section.writes.insert(sum);
    return fmt::format("        {0} = wr_fma({1}, m * {2}, {0});\n", sum, gradient, strength());
}

}  // namespace wrinkle
