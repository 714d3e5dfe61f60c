#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "plan/decal_order.h"
#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kDecal = 90;  // expected operations, for the one decal that a pixel of an average table lies in

/// Gives every row its texture: one for each region of an image that is used, wrapped as it is used.
std::vector<PlannedDecals::Image> plan_images(Plan& plan, const DecalsLayer& layer, const std::string& who) {
    std::map<std::tuple<std::uint32_t, std::array<double, 4>, Wrap>, std::uint32_t> known;
    std::vector<PlannedDecals::Image> images;
    images.reserve(layer.rows->size());
    for (const Projector& row : *layer.rows) {
        if (row.texture >= layer.textures.size())
            throw Error(
                fmt::format("{}: a row names texture {}; the layer has {}", who, row.texture, layer.textures.size()));
        TextureUse use = layer.textures[row.texture];
        use.wrap = row.wrap;
        use.upscale = Upscale::smooth;
        use.unit = SlopeUnit::metre;
        const auto [found, is_new] =
            known.try_emplace({row.texture, row.region, row.wrap}, static_cast<std::uint32_t>(plan.textures.size()));
        if (is_new) plan.textures.push_back({use, TexelKind::slope, {}, row.region});
        images.push_back({found->second, use.content == Content::height});
    }
    return images;
}

/// Text that multiplies `weight` by what the row's own mask says.
std::string row_masks(LayerText& at, const DecalsLayer& layer, PlannedDecals& table) {
    const std::vector<Projector>& rows = *table.rows;
    if (std::ranges::any_of(rows, [](const Projector& row) { return row.object && !row.cryptomatte.empty(); }))
        throw Error(at.who + ": a row has both an object and a Cryptomatte object; give one");
    std::string text;
    if (std::ranges::any_of(rows, [](const Projector& row) { return row.object.has_value(); })) {
        at.emitter.need(at.who, {"object"});
        at.section.inputs.insert("object");
        text +=
            "                    if (decal->mask == 1) weight *= wr_mask_object(wr_load(in_object, at.in), "
            "decal->object);\n";
    }
    if (std::ranges::none_of(rows, [](const Projector& row) { return !row.cryptomatte.empty(); })) return text;
    at.emitter.need(at.who, {"crypto.id0", "crypto.coverage0"});
    std::map<std::string, std::uint32_t> hashes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string& name = rows[i].cryptomatte;
        const auto [found, is_new] = hashes.try_emplace(name);
        if (is_new && !name.empty())
            found->second = at.emitter.cryptomatte_hash(name, at.who + ": " + row_place(layer, i));
        table.hashes.push_back(found->second);
    }
    text += "                    if (decal->mask == 2) {\n                        wr_real covered = 0;\n";
    for (int rank = 0; at.emitter.has(fmt::format("crypto.id{}", rank)); ++rank) {
        const std::string id = fmt::format("crypto.id{}", rank), coverage = fmt::format("crypto.coverage{}", rank);
        at.section.inputs.insert({id, coverage});
        text += fmt::format(
            "                        covered += wr_projector_cryptomatte(decal, wr_load_floats({}, at.in), wr_load({}, "
            "at.in));\n",
            identifier(id), identifier(coverage));
    }
    return text + "                        weight *= wr_mask_channel(covered);\n                    }\n";
}

}  // namespace

std::string emit(LayerText& at, const DecalsLayer& l) {
    if (!l.rows || l.rows->empty()) return {};
    Plan& plan = at.emitter.plan;
    const std::size_t first = plan.projectors, last = first + l.rows->size();
    PlannedDecals& table = plan.tables.emplace_back();
    table.rows = l.rows;
    table.order = decal_order(*l.rows);
    table.images = plan_images(plan, l, at.who);
    table.scale = at.layer.blend == Blend::subtract ? -at.layer.scale : at.layer.scale;
    plan.projectors = last;

    // Row numbers stand in the text only where they must: a table of another length is the same program.
    const auto is_table = [](const Layer& layer) { return std::holds_alternative<DecalsLayer>(layer.bump); };
    const std::string another_table =
        std::ranges::count_if(at.emitter.scene.layers, is_table) > 1
            ? fmt::format("                    if (number < {}u || number >= {}u) continue;  // of another layer\n",
                          first, last)
            : "";

    const bool facing = at.emitter.options.view_footprint;
    at.section.reads.insert({"p", "dh_dp"});
    at.section.writes.insert("dh_dp");
    if (!facing) at.section.reads.insert("n");
    if (at.layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    at.section.operations += kDecal + sample_cost({});
    return fmt::format(
        R"(        wr_vec3 sum = wr_zero3();
        wr_index tile = wr_tile_number(wr_to_index(at.x), wr_to_index(at.y) - (int)first_row, (int)supers);
        for (wr_mask left = active; wr_any(left);) {{
            int bin = wr_first_tile(tile, left);
            wr_mask here = left & wr_to_mask(tile == bin);
            left = left & !here;
            uint begin = lists[WR_LIST_WORDS * bin + WR_LIST_FIRST];
            uint end = begin + lists[WR_LIST_WORDS * bin + WR_LIST_COUNT];
            for (uint from = begin; from < end; from += 32) {{
                uint touching = 0;  // those that some pixel lies in; no branch waits for a test
                for (uint k = 0; k < min(end - from, 32u); ++k)
                    touching |= (uint)(wr_any(here & wr_in_box(projectors + entries[from + k], p)) ? 1 : 0) << k;
                for (; touching != 0; touching &= touching - 1) {{
                    uint number = entries[from + wr_first_bit(touching)];
{}                    global const wr_projector *decal = projectors + number;
                    wr_projected in = wr_project(decal, p);
                    wr_mask touched = here & in.inside;
                    wr_real weight = touched ? wr_projector_falloff(decal, in){} : (wr_real)(0);
{}                    if (!wr_any(weight != 0)) continue;
                    wr_texture t = wr_texture_at(texels, textures, (uint)decal->texture);
                    wr_real lod = {};
                    sum = wr_projector_blend(decal, in, wr_projector_slope(t, decal, in, lod, weight != 0), weight, sum);
                }}
            }}
        }}
        dh_dp = wr_fma(sum, m, dh_dp);
)",
        another_table, facing ? "" : " * wr_projector_angle_fade(decal, n)", row_masks(at, l, table),
        at.layer.footprint
            ? "wr_texture_lod(t, wr_projector_step(decal, in, dp_dx), wr_projector_step(decal, in, dp_dy))"
            : "0");
}

PlannedKernel emit_bins(const Emitter& emitter, std::string& source) {
    const PlannedKernel tiles = emit_tiles(emitter, source);
    const char* binned =
        "global const float *boxes, global const float *bounds, global const float *groups, uint decals,\n"
        "    global uint *entries, uint capacity, global uint *used";
    source += fmt::format(
        R"(kernel void wr_bin_parents(global const float *child_bounds, global float *bounds, uint parents)
{{
    if (get_global_id(0) < parents)
        wr_bin_around(child_bounds, 16 * parents, get_global_id(0), bounds, parents);
}}

kernel void wr_bin_supers({0},
    global const float *tile_bounds, uint tiles, global uint *lists)
{{
    wr_binned all = {{boxes, bounds, groups, decals}};
    if (get_global_id(0) < tiles)
        wr_bin_super(all, tile_bounds, tiles, get_global_id(0), lists, entries, capacity, used);
}}

kernel void wr_bin_lists({0},
    global const float *child_bounds, uint parents, global const uint *parent_lists, global uint *child_lists,
    global ushort *hits)
{{
    wr_binned all = {{boxes, bounds, groups, decals}};
    if (get_global_id(0) < parents)
        wr_bin_children(all, child_bounds, 16 * parents, get_global_id(0), parent_lists, child_lists, entries, hits,
                        capacity, used);
}}

)",
        binned);
    return tiles;
}

}  // namespace wrinkle
