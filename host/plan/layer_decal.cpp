#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kDecal = 75;  // expected operations
}

bool same_loop(const Layer& a, const Layer& b) {
    const auto plain = [](const Layer& l) {
        return !l.mask.object && !l.mask.cryptomatte && !l.mask.channel && !l.mask.texture && !l.mask.invert;
    };
    const bool same_mask =
        (plain(a) && plain(b)) || (!a.mask.texture && !b.mask.texture && a.mask.object == b.mask.object &&
                                   a.mask.cryptomatte == b.mask.cryptomatte && a.mask.channel == b.mask.channel &&
                                   a.mask.invert == b.mask.invert);
    const TextureUse &ta = std::get<DecalLayer>(a.bump).texture, &tb = std::get<DecalLayer>(b.bump).texture;
    return same_mask && a.footprint == b.footprint && sample_function(ta) == sample_function(tb);
}

std::string emit_decals(LayerText& at, const std::vector<const Layer*>& layers) {
    const std::size_t first = at.emitter.plan.decals.size();
    for (const Layer* layer : layers) {
        const auto& decal = std::get<DecalLayer>(layer->bump);
        at.emitter.plan.decals.push_back(decal);
        at.emitter.plan.decal_scales.push_back(layer->blend == Blend::subtract ? -layer->scale : layer->scale);
        at.emitter.plan.decal_textures.push_back(at.emitter.texture(decal.texture, texel_kind(decal.texture)));
        at.section.operations += kDecal + sample_cost(decal.texture);
    }
    const Layer& layer = *layers.front();
    const bool facing = at.emitter.options.view_footprint;
    at.section.reads.insert({"p", "dh_dp"});
    at.section.writes.insert("dh_dp");
    if (!facing) at.section.reads.insert("n");
    if (layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    return fmt::format(
        R"(        for (uint i = {}; i < {}; ++i) {{
            global const wr_decal *decal = decals + i;
            wr_decal_point in = wr_decal_locate(decal, p);
{}            real weight = m * wr_decal_falloff(decal, in){};
            wr_texture t = wr_texture_at(texels, textures, (uint)decal->texture);
            vec2 slope = {}(t, in.st, {});
            dh_dp = wr_add(dh_dp, wr_decal_gradient(decal, slope, weight));
        }}
)",
        first, first + layers.size(),
        at.emitter.options.skip ? "            if (!wr_any(active & in.inside)) continue;\n" : "",
        facing ? "" : " * wr_decal_angle_fade(decal, n)", sample_function(std::get<DecalLayer>(layer.bump).texture),
        layer.footprint ? "wr_texture_lod(t, wr_decal_step(decal, dp_dx), wr_decal_step(decal, dp_dy))" : "(real)(0)");
}

}  // namespace wrinkle
