#include <fmt/format.h>

#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {
constexpr double kDecal = 75, kMixed = 140;  // expected operations
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
    const bool same_mode = std::get<DecalLayer>(a.bump).mode == std::get<DecalLayer>(b.bump).mode;
    return same_mask && same_mode && a.footprint == b.footprint && texel_kind(ta) == texel_kind(tb) &&
           ta.wrap == tb.wrap;
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
    const bool projector = std::get<DecalLayer>(layer.bump).mode == DecalMode::projector;
    if (projector && facing) throw Error(at.who + ": mode = \"projector\" mixes normals, and this pass knows none");
    at.section.reads.insert({"p", "dh_dp"});
    at.section.writes.insert(projector ? "g" : "dh_dp");
    if (projector) {
        at.section.reads.insert("g");
        at.section.operations += static_cast<double>(layers.size()) * kMixed;
    }
    if (!facing) at.section.reads.insert("n");
    if (layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    return fmt::format(
        R"(        for (uint i = {}; i < {}; ++i) {{
            global const wr_decal *decal = decals + i;
            wr_decal_point in = wr_decal_locate(decal, p);
{}            wr_real weight = m * wr_decal_falloff(decal, in){};
            wr_texture t = wr_texture_at(texels, textures, (uint)decal->texture);
            wr_real lod = {};
            wr_vec2 slope = {};
            {}
        }}
)",
        first, first + layers.size(),
        at.emitter.options.skip ? "            if (!wr_any(active & in.inside)) continue;\n" : "",
        facing ? "" : " * wr_decal_angle_fade(decal, n)",
        layer.footprint ? "wr_texture_lod(t, wr_decal_step(decal, dp_dx), wr_decal_step(decal, dp_dy))" : "0",
        sample_text(std::get<DecalLayer>(layer.bump).texture, "in.st", "lod", "weight != 0"),
        projector ? "wr_vec3 below = wr_add(g, wr_surface_gradient_from_volume(n, dh_dp));\n"
                    "            g = wr_add(g, wr_sub(wr_combine_towards(n, below, wr_decal_bumped_axis(decal, slope), "
                    "weight), below));"
                  : "dh_dp = wr_add(dh_dp, wr_decal_gradient(decal, slope, weight));");
}

}  // namespace wrinkle
