#include <cmath>
#include <numbers>

#include "base/vec.h"
#include "scene/layer_readers.h"

namespace wrinkle::scene {

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
    table.choose("mode", bump.mode,
                 {{"surface_gradient", DecalMode::surface_gradient}, {"projector", DecalMode::projector}});
    read_weight(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
