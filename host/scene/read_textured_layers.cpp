#include "scene/layer_readers.h"

namespace wrinkle::scene {

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

}  // namespace wrinkle::scene
