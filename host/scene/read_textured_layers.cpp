#include "scene/layer_readers.h"

namespace wrinkle::scene {

void read_normal_map(Table& table, Layer& layer) {
    NormalMapLayer bump;
    read_texture_file(table, bump.texture);
    read_green(table, bump.texture);
    read_mapped(table, bump.texture, bump.uv);
    table.choose("combine", bump.combine,
                 {{"surface_gradient", Combine::surface_gradient},
                  {"whiteout", Combine::whiteout},
                  {"udn", Combine::udn},
                  {"rnm", Combine::rnm},
                  {"linear", Combine::linear}});
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

void read_height_channel(Table& table, Layer& layer) {
    HeightChannelLayer bump;
    table.require("channel");
    table.read("channel", bump.channel);
    read_weight(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
