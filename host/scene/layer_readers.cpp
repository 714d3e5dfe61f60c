#include "scene/layer_readers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/udim.h"

namespace wrinkle::scene {
namespace {

const char* name_of(Content content) {
    const char* const names[] = {"height", "normal", "slope", "object_normal"};
    return names[static_cast<int>(content)];
}

void read_wrap(Table& table, TextureUse& texture) {
    table.choose("wrap", texture.wrap, {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}});
}

void read_encoding(Table& table, TextureUse& texture) {
    table.choose("encoding", texture.encoding,
                 {{"auto", Encoding::automatic}, {"signed", Encoding::sign}, {"unit", Encoding::unit}});
}

}  // namespace

void read_place(Table& table, Layer& layer) {
    table.read("footprint", layer.footprint);
    const bool masked =
        !layer.mask.object.empty() || !layer.mask.cryptomatte.empty() || layer.mask.channel || layer.mask.texture;
    if (auto mask = table.table("mask", "mask of " + table.where(), masked || layer.mask.invert))
        read_mask(*mask, layer.mask);
}

void read_weight(Table& table, Layer& layer) {
    table.read("scale", layer.scale);
    table.choose("blend", layer.blend, {{"add", Blend::add}, {"subtract", Blend::subtract}}, Compiled::no);
    read_place(table, layer);
}

void read_weight_without_levels(Table& table, Layer& layer) {
    read_weight(table, layer);
    if (table.has("footprint") && !layer.mask.texture)
        table.complain("footprint", "has no effect here: this kind has no levels of detail, only a mask's texture has");
}

void read_project(Table& table, Layer& layer) { table.read("project", layer.project); }

void read_texture_choice(Table& table, TextureUse& texture) {
    table.read("layer", texture.layer, Compiled::no);
    table.read("channels", texture.channels);
    table.read("zero", texture.zero, 0, 65535);
    if (table.has("channels") && table.has("layer"))
        table.complain("channels", "names channels beside a layer; keep one of them");
}

bool read_texture_name(Table& table, TextureUse& texture) {
    if (!table.is_table("texture")) return table.read_file("texture", texture.file);
    Table parts = *table.table("texture", "texture of " + table.where());
    parts.require("file");
    const bool named = parts.read_file("file", texture.file);
    read_texture_choice(parts, texture);
    parts.finish();
    return named;
}

void read_texture_file(Table& table, TextureUse& texture) {
    table.require("texture");
    read_texture_name(table, texture);
    if (table.visits()) visit_texture(table, texture);
}

void read_texture_of(Table& table, TextureUse& texture, Content content) {
    read_texture_file(table, texture);
    if (table.visits()) table.choose("content", texture.content, {{name_of(content), content}});
}

void visit_texture(Table& table, TextureUse& texture) {
    table.choose("content", texture.content,
                 {{"height", Content::height},
                  {"normal", Content::normal},
                  {"slope", Content::slope},
                  {"object_normal", Content::object_normal}});
    read_any_upscale(table, texture);
    read_wrap(table, texture);
    table.compiled_in("y", texture.y_down);
    read_encoding(table, texture);
    table.choose("slopes", texture.unit,
                 {{"texel", SlopeUnit::texel}, {"texture", SlopeUnit::texture}, {"metre", SlopeUnit::metre}});
    table.compiled_in("layer", texture.layer);
    table.compiled_in("channels", fmt::format("{}", fmt::join(texture.channels, " ")));
    table.compiled_in("zero", texture.zero);
}

void read_green(Table& table, TextureUse& texture) { table.choose("y", texture.y_down, {{"+", false}, {"-", true}}); }

void read_upscale(Table& table, TextureUse& texture) {
    table.choose("upscale", texture.upscale, {{"plain", Upscale::plain}, {"smooth", Upscale::smooth}});
}

void read_any_upscale(Table& table, TextureUse& texture) {
    table.choose("upscale", texture.upscale,
                 {{"plain", Upscale::plain}, {"smooth", Upscale::smooth}, {"taps", Upscale::taps}});
}

void read_slope_encoding(Table& table, TextureUse& texture) {
    read_encoding(table, texture);
    table.choose("slopes", texture.unit, {{"texel", SlopeUnit::texel}, {"texture", SlopeUnit::texture}});
}

void refuse_tiles(Table& table, const char* key, const TextureUse& texture) {
    if (io::is_udim(texture.file))
        table.complain(key, "names tiles by <UDIM>, which only textures on texture coordinates (uv) may have");
}

void read_any_texture(Table& table, TextureUse& texture) {
    read_texture_file(table, texture);
    refuse_tiles(table, "texture", texture);
    table.choose("content", texture.content, {{"height", Content::height}, {"normal", Content::normal}});
    read_green(table, texture);
    read_upscale(table, texture);
    table.only_with("y", texture.content == Content::normal, "content", "normal");
    table.only_with("upscale", texture.content == Content::height, "content", "height");
}

void span_tiles(Table& table, const TextureUse& texture, UvMapping& mapping) {
    if (table.visits() || !io::is_udim(texture.file)) return;
    const io::UdimSpan span = io::udim_span(io::udim_tiles(texture.file));
    if (mapping.rotation != 0 && span.columns != span.rows)
        table.complain("uv", "must not rotate a texture of <UDIM> tiles");
    mapping.scale[0] /= span.columns, mapping.offset[0] /= span.columns;
    mapping.scale[1] /= span.rows, mapping.offset[1] /= span.rows;
}

void read_mapped(Table& table, TextureUse& texture, UvMapping& mapping) {
    read_wrap(table, texture);
    if (auto uv = table.table("uv", "uv of " + table.where())) read_uv(*uv, mapping);
    span_tiles(table, texture, mapping);
}

}  // namespace wrinkle::scene
