#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/kinds.h"
#include "scene/readers.h"
#include "scene/vec.h"

namespace wrinkle::scene {
namespace {

// --- Keys that several kinds share ----------------------------------------------------------------------------------

void read_weight(Table& table, Layer& layer) {
    table.read("scale", layer.scale);
    table.choose("blend", layer.blend, {{"add", Blend::add}, {"subtract", Blend::subtract}});
    table.read("footprint", layer.footprint);
    if (auto mask = table.table("mask", "mask of " + table.where())) read_mask(*mask, layer.mask);
}

void read_texture_file(Table& table, TextureUse& texture) {
    table.require("texture");
    table.read_file("texture", texture.file);
}

void read_green(Table& table, TextureUse& texture) { table.choose("y", texture.y_down, {{"+", false}, {"-", true}}); }

void read_upscale(Table& table, TextureUse& texture) {
    table.choose("upscale", texture.upscale, {{"plain", Upscale::plain}, {"smooth", Upscale::smooth}});
}

/// For kinds whose texture holds either content.
void read_any_texture(Table& table, TextureUse& texture) {
    read_texture_file(table, texture);
    table.choose("content", texture.content, {{"height", Content::height}, {"normal", Content::normal}});
    read_green(table, texture);
    read_upscale(table, texture);
    table.only_with("y", texture.content == Content::normal, "content", "normal");
    table.only_with("upscale", texture.content == Content::height, "content", "height");
}

void read_mapped(Table& table, TextureUse& texture, UvMapping& mapping) {
    table.choose("wrap", texture.wrap, {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}});
    if (auto uv = table.table("uv", "uv of " + table.where())) read_uv(*uv, mapping);
}

// --- Kinds -----------------------------------------------------------------------------------------------------------

void read_normal_map(Table& table, Layer& layer) {
    NormalMapLayer bump;
    read_texture_file(table, bump.texture);
    read_green(table, bump.texture);
    read_mapped(table, bump.texture, bump.uv);
    read_weight(table, layer);
    layer.bump = bump;
}

void read_height_map(Table& table, Layer& layer) {
    HeightMapLayer bump;
    read_texture_file(table, bump.texture);
    read_upscale(table, bump.texture);
    read_mapped(table, bump.texture, bump.uv);
    read_weight(table, layer);
    layer.bump = bump;
}

void read_triplanar(Table& table, Layer& layer) {
    TriplanarLayer bump;
    read_any_texture(table, bump.texture);
    table.read("tile", bump.tile, positive);
    table.read("sharpness", bump.sharpness, {.low = 0, .high = 1000, .low_is_allowed = false});
    read_weight(table, layer);
    layer.bump = bump;
}

void read_noise(Table& table, Layer& layer) {
    // The bounds keep the frequency and the amplitude of a 16th octave within float32.
    NoiseLayer bump;
    table.read("frequency", bump.frequency, {.low = 0, .high = 1e9, .low_is_allowed = false});
    table.read("octaves", bump.octaves, 1, 16);
    table.read("lacunarity", bump.lacunarity, {.low = 0, .high = 16, .low_is_allowed = false});
    table.read("gain", bump.gain, {.low = 0, .high = 16});
    read_weight(table, layer);
    layer.bump = bump;
}

void read_decal(Table& table, Layer& layer) {
    DecalLayer bump;
    bump.texture.wrap = Wrap::clamp;
    read_any_texture(table, bump.texture);
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
    table.read("half_size", bump.half_size, positive);
    table.read("falloff", bump.falloff, zero_to_one);
    std::array<double, 2> degrees{};
    if (table.read("angle_fade", degrees, {.low = 0, .high = 180})) {
        if (degrees[0] > degrees[1])
            table.complain("angle_fade", "must be [full below, zero above] in degrees, the smaller angle first");
        const auto cosine = [](double angle) { return std::cos(angle * std::numbers::pi / 180); };
        bump.angle_fade = {cosine(degrees[1]), cosine(degrees[0])};
    }
    read_weight(table, layer);
    layer.bump = bump;
}

void read_constant(Table& table, Layer& layer) {
    ConstantLayer bump;
    table.require("gradient");
    table.read("gradient", bump.gradient);
    read_weight(table, layer);
    layer.bump = bump;
}

void read_resolve(Table&, Layer& layer) { layer.bump = ResolveLayer{}; }

constexpr Kind<Layer> kinds[] = {
    {"normal_map", read_normal_map}, {"height_map", read_height_map}, {"triplanar", read_triplanar},
    {"noise", read_noise},           {"decal", read_decal},           {"constant", read_constant},
    {"resolve", read_resolve},
};

}  // namespace

void read_layer(Table& table, std::size_t number, Layer& out) {
    out.location = table.location();
    const bool is_named = table.read("name", out.name);
    if (is_named) table.rename("[[layer]] " + quote(out.name));
    const Kind<Layer>* kind = choose_kind<Layer>(table, kinds);
    if (!is_named) {
        out.name = fmt::format("{} {}", kind ? kind->name : "layer", number);
        if (kind) table.rename("[[layer]] " + quote(out.name));
    }
    read_as_kind<Layer>(table, kinds, kind, out);
}

}  // namespace wrinkle::scene
