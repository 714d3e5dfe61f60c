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

}  // namespace

void read_triplanar(Table& table, Layer& layer) {
    TriplanarLayer bump;
    read_any_texture(table, bump.texture);
    table.read("tile", bump.tile, positive);
    table.read("sharpness", bump.sharpness, {.low = 0, .high = 1000, .low_is_allowed = false});
    table.choose("origin", bump.origin,
                 {{"lower_left", TextureOrigin::lower_left}, {"upper_left", TextureOrigin::upper_left}});
    table.choose("handedness", bump.handedness, {{"left", Handedness::left}, {"right", Handedness::right}});
    table.choose("mode", bump.mode,
                 {{"surface_gradient", TriplanarMode::surface_gradient},
                  {"perlin", TriplanarMode::perlin},
                  {"geiss", TriplanarMode::geiss}});
    if (bump.mode == TriplanarMode::geiss && bump.texture.content != Content::normal)
        table.complain("mode", "can be \"geiss\" only with content = \"normal\": it uses normals as they are");
    if (auto placement = table.table("transform", "transform of " + table.where()))
        read_placement(*placement, bump.transform);
    read_weight(table, layer);
    layer.project = bump.mode == TriplanarMode::surface_gradient;
    layer.bump = bump;
}

}  // namespace wrinkle::scene
