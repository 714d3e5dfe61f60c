#include <fmt/format.h>

#include <cmath>

#include "base/vec.h"
#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kDecal = 75, kMixed = 140;  // expected operations

const DecalLayer& decal_of(const Layer& layer) { return std::get<DecalLayer>(layer.bump); }

/// Files give angles where scenes hold cosines.
void read_angle_fade(scene::Table& table, std::array<double, 2>& cosines) {
    const char* const key = "angle_fade";
    if (table.visits()) {
        if (table.read(key, cosines, {.low = -1, .high = 1}) && cosines[0] > cosines[1])
            table.complain(key, "must be cosines [zero below, full above], the smaller one first");
        return;
    }
    std::array<double, 2> degrees{};
    if (!table.read(key, degrees, {.low = 0, .high = 180})) return;
    if (degrees[0] > degrees[1])
        table.complain(key, "must be [full below, zero above] in degrees, the smaller angle first");
    cosines = {std::cos(scene::to_radians(degrees[1])), std::cos(scene::to_radians(degrees[0]))};
}

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<DecalLayer>(layer);
    scene::read_any_texture(table, bump.texture);
    table.require("center");
    table.read("center", bump.center);
    table.read("axis_x", bump.axis_x);
    table.read("axis_y", bump.axis_y);
    if (!table.is_bad("axis_x") && !table.is_bad("axis_y")) {
        if (parallel(bump.axis_x, bump.axis_y)) {
            table.complain(table.has("axis_y") ? "axis_y" : "axis_x",
                           "must not make axis_x and axis_y parallel, and neither may be zero");
        } else {
            bump.axis_x = normalize(bump.axis_x);
            const Vec3 axis_z = normalize(cross(bump.axis_x, normalize(bump.axis_y)));
            bump.axis_y = cross(axis_z, bump.axis_x);
        }
    }
    table.read("half_size", bump.half_size, scene::positive);
    table.read("falloff", bump.falloff, scene::zero_to_one);
    read_angle_fade(table, bump.angle_fade);
    table.read("two_sided", bump.two_sided, scene::Compiled::no);
    table.choose("mode", bump.mode,
                 {{"surface_gradient", DecalMode::surface_gradient}, {"projector", DecalMode::projector}});
    scene::read_weight(table, layer);
    layer.bump = bump;
}

/// The decal as a row of a table.
Projector row(const Layer& layer) {
    const DecalLayer& decal = decal_of(layer);
    return {.center = decal.center,
            .axis_x = decal.axis_x,
            .axis_y = decal.axis_y,
            .half_size = decal.half_size,
            .falloff = {decal.falloff, decal.falloff, decal.falloff},
            .angle_fade = decal.angle_fade,
            .two_sided = decal.two_sided};
}

/// Whether two decals can share a loop: they have the same mask and are sampled alike. Masks of objects never count as
/// the same, because which object one is for is not compiled in.
bool joins(const Layer& a, const Layer& b) {
    const auto of_an_object = [](const Mask& mask) {
        return !mask.object.empty() || !mask.cryptomatte.empty() || mask.texture;
    };
    const bool same_mask = !of_an_object(a.mask) && !of_an_object(b.mask) && a.mask.channel == b.mask.channel &&
                           a.mask.invert == b.mask.invert;
    const TextureUse &ta = decal_of(a).texture, &tb = decal_of(b).texture;
    return same_mask && decal_of(a).mode == decal_of(b).mode && a.footprint == b.footprint &&
           texel_kind(ta) == texel_kind(tb) && ta.wrap == tb.wrap;
}

std::string emit(LayerText& at) {
    Plan& plan = at.emitter.plan;
    const std::size_t first = plan.decals.size();
    for (const Layer* layer : at.layers) {
        const TextureUse& texture = decal_of(*layer).texture;
        const auto number = static_cast<std::uint32_t>(at.emitter.texture(texture, texel_kind(texture)));
        plan.decals.push_back({at.emitter.index_of(*layer), {number, texture.content == Content::height}, row});
        at.section.operations += kDecal + sample_cost(texture);
    }
    const bool facing = at.emitter.options.view_footprint;
    const bool mixed = decal_of(at.layer).mode == DecalMode::projector;
    if (mixed && (facing || at.emitter.options.volume_gradient))
        throw Error(at.who + ": mode = \"projector\" mixes normals, and sums of gradients know none");
    at.section.reads.insert("p");
    at.section.writes.insert(mixed ? "g" : "dh_dp");
    if (mixed)
        at.section.operations += static_cast<double>(at.layers.size()) * kMixed;
    else
        at.section.reads.insert("dh_dp");
    if (!facing) at.section.reads.insert("n");
    if (at.layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    // Which boxes a pixel's area may cross is found once for all of its points: most cross none.
    std::string rows = fmt::format("uint i = {}; i < {}; ++i", first, plan.decals.size()), crossed;
    if (at.over_area() && at.emitter.options.skip && at.emitter.scene.filter.taps > 1) {
        const std::string crosses = fmt::format("crosses_{}", first);
        at.declared += fmt::format("        uint {} = 0;\n", crosses);
        at.before += fmt::format(
            "        for (uint i = 0; i < {0}; ++i)\n"
            "            {1} |= (uint)(wr_any(valid & wr_may_cross_box(decals + {2} + i, p, taps.along, shares.begin,\n"
            "                fma(shares.length, taps.count, shares.begin))) ? 1 : 0) << i;\n",
            at.layers.size(), crosses, first);
        rows = fmt::format("uint i = {}, rest = {}; rest != 0; ++i, rest >>= 1", first, crosses);
        crossed = "            if ((rest & 1) == 0) continue;\n";
    }
    return fmt::format(
        R"(        for ({}) {{
{}            global const wr_projector *decal = decals + i;
            wr_projected in = wr_project_box(decal, p);
{}            wr_real weight = m * wr_projector_falloff(decal, in){};
            wr_texture t = wr_texture_at(texels, textures, (uint)decal->texture);
            wr_real lod = {};
            wr_vec2 slope = {};
            {}
        }}
)",
        rows, crossed, at.emitter.options.skip ? "            if (!wr_any(active & in.inside)) continue;\n" : "",
        facing ? "" : " * wr_projector_angle_fade(decal, n)",
        at.lod("wr_projector_step(decal, in, dp_dx)", "wr_projector_step(decal, in, dp_dy)"),
        sample_text(decal_of(at.layer).texture, "wr_projector_st(in)", "lod", "weight != 0"),
        mixed ? "wr_vec3 below = " + at.below() +
                    ";\n"
                    "            g = wr_add(g, wr_sub(wr_combine_towards(n, below, wr_projector_bumped_axis(decal, in, "
                    "slope), "
                    "weight), below));"
              : "dh_dp = wr_projector_blend(decal, in, slope, weight, dh_dp);");
}

}  // namespace

const LayerKind& layers::decal() {
    static constexpr LayerKind kind{
        .name = DecalLayer::kind, .read = read, .emit = emit, .without_normal = true, .joins = joins};
    return kind;
}

}  // namespace wrinkle
