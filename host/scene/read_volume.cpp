#include "io/volume.h"
#include "scene/layer_readers.h"

namespace wrinkle::scene {

void read_volume(Table& table, Layer& layer) {
    VolumeLayer bump;
    table.require("volume");
    table.read_file("volume", bump.file);
    table.read("grid", bump.grid);
    table.choose("filter", bump.filter, {{"linear", VolumeFilter::linear}, {"smooth", VolumeFilter::smooth}});
    table.choose("remap", bump.remap,
                 {{"none", Remap::none}, {"ramp", Remap::ramp}, {"smooth", Remap::smooth}, {"wave", Remap::wave}});
    table.read("range", bump.range);
    if (static_cast<float>(bump.range[0]) == static_cast<float>(bump.range[1]))
        table.complain("range", "must be two different numbers");
    table.only_with("range", bump.remap != Remap::none, "remap", "ramp\", \"smooth\" or \"wave");
    if (table.read_matrix("transform", bump.transform)) {
        const auto& last = bump.transform[3];
        if (last[0] != 0 || last[1] != 0 || last[2] != 0 || last[3] != 1)
            table.complain("transform", "must be affine: its last row is [0, 0, 0, 1]");
        else if (is_singular(bump.transform))
            table.complain("transform", "cannot be inverted: its columns are zero or parallel");
    }
    read_weight_without_levels(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
