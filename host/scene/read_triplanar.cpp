#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scene/layer_readers.h"

namespace wrinkle::scene {

namespace {

void read_placement(Table& table, Placement& out) {
    table.read("translate", out.translate);
    Vec3 degrees{};
    if (table.read("rotate", degrees))
        for (std::size_t k = 0; k < 3; ++k) out.rotate[k] = degrees[k] * std::numbers::pi / 180;
    if (table.has("scale") && !table.is_array("scale")) {
        double all = 1;
        if (table.read("scale", all)) out.scale = {all, all, all};
    } else {
        table.read("scale", out.scale);
    }
    for (const double factor : out.scale)
        if (std::abs(factor) < 1e-6 || std::abs(factor) > 1e6) {
            table.complain("scale", "must be from 1e-6 to 1e6 in size (negative mirrors)");
            break;
        }
    table.finish();
}

/// texture and what its content asks for
void read_plane_texture(Table& table, TextureUse& texture) {
    read_texture_file(table, texture);
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
PlaneSource read_plane(Table& table) {
    PlaneSource plane;
    table.read("scale", plane.scale);
    if (auto noise = table.table("noise", "noise of " + table.where())) {
        NoiseLayer bump;
        read_noise_source(*noise, bump);
        noise->finish();
        plane.content = bump;
        table.know("texture");
        if (table.has("texture")) table.complain("texture", "and \"noise\" exclude each other; choose one");
    } else if (!table.is_bad("noise")) {
        TextureUse texture;
        read_plane_texture(table, texture);
        plane.content = texture;
    }
    table.finish();
    return plane;
}

/// planes, and what those without an own source show
void read_planes(Table& table, TriplanarLayer& bump) {
    std::size_t own = 0;
    if (auto planes = table.table("planes", "planes of " + table.where())) {
        const char* const names[] = {"x", "y", "z"};
        for (std::size_t k = 0; k < 3; ++k)
            if (auto plane = planes->table(names[k], fmt::format("plane {} of {}", names[k], table.where())))
                bump.planes[k] = read_plane(*plane), ++own;
        planes->finish();
    }
    if (own < 3) return read_plane_texture(table, bump.texture);
    for (const char* key : {"texture", "content", "y", "upscale", "encoding", "slopes"})
        if (table.has(key)) {
            table.know(key);
            table.complain(key, "is for planes without a source of their own, and \"planes\" names all three");
        }
}

/// Every source of a plane.
template <class Holds>
bool every_plane(const TriplanarLayer& bump, const Holds& holds) {
    bool all = true;
    for (const auto& plane : bump.planes)
        all = all && std::visit(holds, plane ? plane->content : decltype(plane->content)(bump.texture));
    return all;
}

}  // namespace

void read_triplanar(Table& table, Layer& layer) {
    TriplanarLayer bump;
    read_planes(table, bump);
    table.read("tile", bump.tile, positive);
    table.read("sharpness", bump.sharpness, {.low = 0, .high = 1000, .low_is_allowed = false});
    table.choose("origin", bump.origin,
                 {{"lower_left", TextureOrigin::lower_left}, {"upper_left", TextureOrigin::upper_left}});
    table.choose("handedness", bump.handedness, {{"left", Handedness::left}, {"right", Handedness::right}});
    table.choose("mode", bump.mode,
                 {{"surface_gradient", TriplanarMode::surface_gradient},
                  {"perlin", TriplanarMode::perlin},
                  {"geiss", TriplanarMode::geiss}});
    const auto tangent = [](const auto& source) {
        if constexpr (requires { source.content; }) return source.content == Content::normal;
        return false;
    };
    if (bump.mode == TriplanarMode::geiss && !every_plane(bump, tangent))
        table.complain("mode", "can be \"geiss\" only with content = \"normal\": it uses normals as they are");
    const auto projects = [](const auto& source) {
        if constexpr (requires { source.content; }) return source.content != Content::object_normal;
        return true;
    };
    if (bump.mode != TriplanarMode::surface_gradient && !every_plane(bump, projects))
        table.complain("mode",
                       "must be \"surface_gradient\" with content = \"object_normal\": such normals have no slopes");
    if (auto placement = table.table("transform", "transform of " + table.where()))
        read_placement(*placement, bump.transform);
    read_weight(table, layer);
    layer.project = bump.mode == TriplanarMode::surface_gradient;
    layer.bump = bump;
}

}  // namespace wrinkle::scene
