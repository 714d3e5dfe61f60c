#include <fmt/format.h>

#include "scene/layer_readers.h"

namespace wrinkle::scene {
namespace {

/// texture and what its content asks for
void read_plane_texture(Table& table, TextureUse& texture) {
    read_texture_file(table, texture);
    refuse_tiles(table, "texture", texture);
    table.choose("content", texture.content,
                 {{"height", Content::height},
                  {"normal", Content::normal},
                  {"slope", Content::slope},
                  {"object_normal", Content::object_normal}});
    read_green(table, texture);
    read_upscale(table, texture);
    read_slope_encoding(table, texture);
    if (table.has("y") && texture.content != Content::normal && texture.content != Content::slope)
        table.complain("y", "makes sense only with content = \"normal\" or \"slope\"");
    table.only_with("upscale", texture.content == Content::height, "content", "height");
    for (const char* key : {"encoding", "slopes"})
        table.only_with(key, texture.content == Content::slope, "content", "slope");
}

/// One plane's own source: texture or noise, and scale.
PlaneSource read_plane(Table& table, PlaneSource plane) {
    const auto* held_noise = std::get_if<NoiseLayer>(&plane.content);
    const auto* held_texture = std::get_if<TextureUse>(&plane.content);
    table.read("scale", plane.scale);
    if (auto noise = table.table("noise", "noise of " + table.where(), held_noise != nullptr)) {
        NoiseLayer bump = held_noise ? *held_noise : NoiseLayer{};
        read_noise_source(*noise, bump);
        noise->finish();
        plane.content = bump;
        table.know("texture");
        if (table.has("texture")) table.complain("texture", "and \"noise\" exclude each other; choose one");
    } else if (!table.is_bad("noise")) {
        TextureUse texture = held_texture ? *held_texture : TextureUse{};
        read_plane_texture(table, texture);
        plane.content = texture;
    }
    table.finish();
    return plane;
}

}  // namespace

void read_planes(Table& table, TriplanarLayer& bump) {
    std::size_t own = 0;
    if (auto planes = table.table("planes", "planes of " + table.where())) {
        const char* const names[] = {"x", "y", "z"};
        for (std::size_t k = 0; k < 3; ++k)
            if (auto plane = planes->table(names[k], fmt::format("plane {} of {}", names[k], table.where()),
                                           bump.planes[k].has_value()))
                bump.planes[k] = read_plane(*plane, bump.planes[k].value_or(PlaneSource{})), ++own;
        planes->finish();
    }
    if (own < 3) return read_plane_texture(table, bump.texture);
    for (const char* key : {"texture", "content", "y", "upscale", "encoding", "slopes"})
        if (table.has(key)) {
            table.know(key);
            table.complain(key, "is for planes without a source of their own, and \"planes\" names all three");
        }
}

}  // namespace wrinkle::scene
