#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "layers/common.h"
#include "plan/decal_order.h"
#include "scene/decal_columns.h"
#include "scene/row_reader.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kDecal = 90;  // expected operations, for the one decal that a pixel of an average table lies in

/// What sets the texture of a row apart.
using Image = std::tuple<std::uint32_t, std::array<double, 4>, Wrap>;
Image image_of(const Projector& row) { return {row.texture, row.region, row.wrap}; }

/// The images of a table, numbered in the order of first use.
class Images {
public:
    /// The number of a row's image, and whether the row is the first to use it.
    std::pair<std::uint32_t, bool> operator()(const Projector& row) {
        Image image = image_of(row);
        if (last_ != known_.end() && last_->first == image) return {last_->second, false};
        const auto [found, is_new] = known_.try_emplace(std::move(image), static_cast<std::uint32_t>(known_.size()));
        last_ = found;
        return {found->second, is_new};
    }

private:
    std::map<Image, std::uint32_t> known_;
    std::map<Image, std::uint32_t>::iterator last_ = known_.end();
};

bool any_object(const std::vector<Projector>& rows) {
    return std::ranges::any_of(rows, [](const Projector& row) { return row.object.has_value(); });
}
bool any_cryptomatte(const std::vector<Projector>& rows) {
    return std::ranges::any_of(rows, [](const Projector& row) { return !row.cryptomatte.empty(); });
}

/// Checks the rows of a scene in memory, and says what of them is compiled in.
void visit_rows(scene::Table& table, const DecalsLayer& bump) {
    static const std::vector<Projector> none;
    const std::vector<Projector>& rows = bump.rows ? *bump.rows : none;
    try {
        const scene::RowKind<Projector> kind = scene::decal_rows(bump.textures.size());
        scene::RowReader<Projector> reader(bump.file.string(), kind, scene::TableForm::memory);
        for (const Projector& row : rows) reader.check(row);
        reader.finish();
    } catch (const Error& error) { table.complain("rows", fmt::format("cannot be used:\n{}", error.what())); }
    Images images;
    std::string used;
    for (const Projector& row : rows)
        if (images(row).second)
            used += fmt::format("{}texture {}, region [{}], {}", used.empty() ? "" : "; ", row.texture,
                                fmt::join(row.region, ", "), row.wrap == Wrap::clamp ? "clamp" : "tile");
    table.compiled_in("rows", std::move(used));
    table.compiled_in("object", any_object(rows));
    table.compiled_in("cryptomatte", any_cryptomatte(rows));
}

void read_rows(scene::Table& table, DecalsLayer& bump) {
    if (table.visits()) return visit_rows(table, bump);
    table.require("file");
    if (!table.read_file("file", bump.file) || bump.textures.empty()) return;
    try {
        bump.rows = std::make_shared<const std::vector<Projector>>(load_decals(bump.file, bump.textures.size()));
    } catch (const Error& error) { table.complain("file", fmt::format("cannot be used:\n{}", error.what())); }
}

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<DecalsLayer>(layer);
    table.require("textures");
    std::vector<scene::Table> tables = table.tables("textures", bump.textures.size());
    table.compiled_in("textures", static_cast<int>(tables.size()));
    bump.textures.resize(tables.size());
    for (std::size_t i = 0; i < tables.size(); ++i) {
        scene::Table& each = tables[i];
        TextureUse& texture = bump.textures[i];
        each.rename(fmt::format("texture {} of {}", i, table.where()));
        each.require("file");
        each.read_file("file", texture.file);
        scene::read_texture_choice(each, texture);
        scene::refuse_tiles(each, "file", texture);
        if (table.visits()) scene::visit_texture(each, texture);
        each.choose("content", texture.content,
                    {{"height", Content::height}, {"normal", Content::normal}, {"slope", Content::slope}});
        scene::read_green(each, texture);
        if (texture.content == Content::height && each.has("y") && !each.is_bad("content"))
            each.complain("y", "has an effect only with content = \"normal\" or \"slope\"; remove it or set that");
        each.finish();
    }
    if (table.has("textures") && bump.textures.empty() && !table.is_bad("textures"))
        table.complain("textures", "must list at least one { file = \"...\" }");
    read_rows(table, bump);
    scene::read_weight(table, layer);
    layer.bump = std::move(bump);
}

/// One texture for each region of an image that is used, wrapped as it is used.
void plan_textures(Plan& plan, const DecalsLayer& layer, const std::string& who) {
    Images images;
    for (const Projector& row : *layer.rows) {
        if (row.texture >= layer.textures.size())
            throw Error(
                fmt::format("{}: a row names texture {}; the layer has {}", who, row.texture, layer.textures.size()));
        if (!images(row).second) continue;
        TextureUse use = layer.textures[row.texture];
        use.wrap = row.wrap;
        use.upscale = Upscale::smooth;
        use.unit = SlopeUnit::metre;
        plan.textures.push_back({use, TexelKind::slope, {}, row.region});
    }
}

/// Cryptomatte hashes of the rows; none where no row has one.
std::vector<std::uint32_t> hashes_of(const DecalsLayer& layer, const NumberSource& source, const std::string& who) {
    std::vector<std::uint32_t> all;
    if (!any_cryptomatte(*layer.rows)) return all;
    std::map<std::string, std::uint32_t> known;
    for (std::size_t i = 0; i < layer.rows->size(); ++i) {
        const std::string& name = (*layer.rows)[i].cryptomatte;
        const auto [found, is_new] = known.try_emplace(name);
        if (is_new && !name.empty())
            found->second = cryptomatte_hash(source.cryptomatte, name, who + ": " + row_place(layer, i));
        all.push_back(found->second);
    }
    return all;
}

/// The rows as kernels see them; `first_texture` is the number of the table's first.
void take_rows(PlannedDecals& table, const NumberSource& source, std::uint32_t first_texture) {
    const Layer& layer = source.scene.layers.at(table.layer);
    const auto& decals = std::get<DecalsLayer>(layer.bump);
    table.rows = decals.rows;
    table.order = decal_order(*decals.rows);
    table.hashes = hashes_of(decals, source, layer_label(layer));
    table.images.clear();
    table.images.reserve(decals.rows->size());
    Images images;
    for (const Projector& row : *decals.rows)
        table.images.push_back(
            {first_texture + images(row).first, decals.textures.at(row.texture).content == Content::height});
}

/// Text that multiplies `weight` by what the row's own mask says.
std::string row_masks(LayerText& at, const std::vector<Projector>& rows) {
    if (std::ranges::any_of(rows, [](const Projector& row) { return row.object && !row.cryptomatte.empty(); }))
        throw Error(at.who + ": a row has both an object and a Cryptomatte object; give one");
    std::string text;
    if (any_object(rows)) {
        at.emitter.need(at.who, {"object"});
        at.section.inputs.insert("object");
        text +=
            "                    if (decal->mask == 1) weight *= wr_mask_object(wr_load(in_object, at.in), "
            "decal->object);\n";
    }
    if (!any_cryptomatte(rows)) return text;
    at.emitter.need(at.who, {"crypto.id0", "crypto.coverage0"});
    text += "                    if (decal->mask == 2) {\n                        wr_real covered = 0;\n";
    for (int rank = 0; at.emitter.has(fmt::format("crypto.id{}", rank)); ++rank) {
        const std::string id = fmt::format("crypto.id{}", rank), coverage = fmt::format("crypto.coverage{}", rank);
        at.section.inputs.insert({id, coverage});
        text += fmt::format(
            "                        covered += wr_projector_cryptomatte(decal, wr_load_floats({}, at.in), wr_load({}, "
            "at.in));\n",
            identifier(id), identifier(coverage));
    }
    // Frames that somebody else made lack the plane; there Cryptomatte's first rank, which covers most, is in front.
    const std::string front = at.emitter.has("crypto.front") ? "crypto.front" : "crypto.id0";
    at.section.inputs.insert(front);
    return text +
           fmt::format(
               "                        wr_floats front = wr_load_floats({}, at.in);\n"
               "                        weight *= wr_mask_channel(wr_mask_front(front,\n"
               "                            wr_projector_cryptomatte(decal, front, (wr_real)(1)), covered, 0));\n"
               "                    }}\n",
               identifier(front));
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

/// Text that skips rows of other layers' tables, if there are any. Row numbers are not compiled in, so that tables of
/// any length share a program. Each is passed as two halves, because a float cannot hold 32 bits.
std::string another_layers(LayerText& at) {
    const std::vector<Layer>& layers = at.emitter.scene.layers;
    if (std::ranges::count_if(layers, [&](const Layer& layer) { return at.emitter.kind(layer).binned; }) < 2) return {};
    const std::size_t index = at.emitter.index_of(at.layer);
    const std::size_t bounds =
        at.emitter.numbers(at.layer, "first and last row", [index](const Layer&, const NumberSource& source) {
            std::vector<double> halves;
            std::size_t rows = 0;
            for (std::size_t i = 0; i <= index; ++i) {
                const auto* table = std::get_if<DecalsLayer>(&source.scene.layers[i].bump);
                if (i == index) halves = {static_cast<double>(rows >> 16), static_cast<double>(rows & 0xffff)};
                if (table && table->rows) rows += table->rows->size();
            }
            halves.insert(halves.end(), {static_cast<double>(rows >> 16), static_cast<double>(rows & 0xffff)});
            return halves;
        });
    const auto row = [](std::size_t half) {
        return fmt::format("((uint)numbers[{}] << 16 | (uint)numbers[{}])", half, half + 1);
    };
    return fmt::format("                    if (number < {} || number >= {}) continue;  // of another layer\n",
                       row(bounds), row(bounds + 2));
}

std::string emit(LayerText& at) {
    const auto& l = std::get<DecalsLayer>(at.layer.bump);
    if (!l.rows || l.rows->empty()) return {};
    Plan& plan = at.emitter.plan;
    const auto first_texture = static_cast<std::uint32_t>(plan.textures.size());
    plan_textures(plan, l, at.who);
    PlannedDecals& table = plan.tables.emplace_back();
    table.layer = at.emitter.index_of(at.layer);
    table.take_rows = [first_texture](PlannedDecals& into, const NumberSource& source) {
        take_rows(into, source, first_texture);
    };
    table.take_rows(table, {at.emitter.scene, at.emitter.available.cryptomatte});
    plan.projectors += l.rows->size();

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
        another_layers(at), facing ? "" : " * wr_projector_angle_fade(decal, n)", row_masks(at, *l.rows),
        at.lod("wr_projector_step(decal, in, dp_dx)", "wr_projector_step(decal, in, dp_dy)"));
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
