#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "layers/common.h"
#include "plan/decal_order.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kDecal = 90;  // expected operations, for the one decal that a pixel of an average table lies in

void read(scene::Table& table, Layer& layer) {
    DecalsLayer bump;
    table.require("textures");
    for (scene::Table& each : table.tables("textures")) {
        TextureUse& texture = bump.textures.emplace_back();
        each.rename(fmt::format("texture {} of {}", bump.textures.size() - 1, table.where()));
        each.require("file");
        each.read_file("file", texture.file);
        each.choose("content", texture.content,
                    {{"height", Content::height}, {"normal", Content::normal}, {"slope", Content::slope}});
        scene::read_green(each, texture);
        if (texture.content == Content::height && each.has("y") && !each.is_bad("content"))
            each.complain("y", "has an effect only with content = \"normal\" or \"slope\"; remove it or set that");
        each.finish();
    }
    if (table.has("textures") && bump.textures.empty() && !table.is_bad("textures"))
        table.complain("textures", "must list at least one { file = \"...\" }");
    table.require("file");
    if (table.read_file("file", bump.file) && !bump.textures.empty()) {
        try {
            bump.rows = std::make_shared<const std::vector<Projector>>(load_decals(bump.file, bump.textures.size()));
        } catch (const Error& error) { table.complain("file", fmt::format("cannot be used:\n{}", error.what())); }
    }
    scene::read_weight(table, layer);
    layer.bump = std::move(bump);
}

/// Gives every row its texture: one for each region of an image that is used, wrapped as it is used.
std::vector<ProjectedImage> plan_images(Plan& plan, const DecalsLayer& layer, const std::string& who) {
    std::map<std::tuple<std::uint32_t, std::array<double, 4>, Wrap>, std::uint32_t> known;
    std::vector<ProjectedImage> images;
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
            found->second =
                cryptomatte_hash(at.emitter.available.cryptomatte, name, at.who + ": " + row_place(layer, i));
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

/// The objects that rows are meant for, each with the first row that names it.
std::vector<NamedObject> objects(const Layer& layer) {
    const auto& table = std::get<DecalsLayer>(layer.bump);
    std::vector<NamedObject> found;
    std::set<std::pair<std::string, double>> known;
    for (std::size_t i = 0; table.rows && i < table.rows->size(); ++i) {
        const Projector& row = table.rows->at(i);
        if (!row.object && row.cryptomatte.empty()) continue;
        if (known.emplace(row.cryptomatte, row.object.value_or(0)).second)
            found.push_back({row.cryptomatte, row.object.value_or(0), row_place(table, i)});
    }
    return found;
}

std::string emit(LayerText& at) {
    const auto& l = std::get<DecalsLayer>(at.layer.bump);
    if (!l.rows || l.rows->empty()) return {};
    Plan& plan = at.emitter.plan;
    const std::size_t first = plan.projectors, last = first + l.rows->size();
    PlannedDecals& table = plan.tables.emplace_back();
    table.layer = at.emitter.index_of(at.layer);
    table.rows = l.rows;
    table.order = decal_order(*l.rows);
    table.images = plan_images(plan, l, at.who);
    plan.projectors = last;

    // Row numbers stand in the text only where they must: a table of another length is the same program.
    const auto is_binned = [&](const Layer& layer) { return at.emitter.kind(layer).binned; };
    const std::string another_table =
        std::ranges::count_if(at.emitter.scene.layers, is_binned) > 1
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

}  // namespace

const LayerKind& layers::decals() {
    static constexpr LayerKind row{.name = DecalsLayer::kind,
                                   .read = read,
                                   .emit = emit,
                                   .without_normal = true,
                                   .binned = true,
                                   .objects = objects};
    return row;
}

}  // namespace wrinkle
