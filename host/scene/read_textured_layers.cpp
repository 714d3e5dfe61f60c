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
    table.choose(
        "frame", bump.frame,
        {{"auto", TangentSource::automatic}, {"derived", TangentSource::derived}, {"tangents", TangentSource::planes}});
    if (bump.frame == TangentSource::planes && (bump.uv.source != UvSource::aov || bump.uv.rotation != 0))
        table.complain("frame",
                       "is \"tangents\", which belongs to the UV pass as it is: uv must not be planar or turn");
    read_weight(table, layer);
    layer.bump = bump;
}

void read_height_map(Table& table, Layer& layer) {
    HeightMapLayer bump;
    read_texture_file(table, bump.texture);
    table.choose("upscale", bump.texture.upscale,
                 {{"plain", Upscale::plain}, {"smooth", Upscale::smooth}, {"taps", Upscale::taps}});
    read_mapped(table, bump.texture, bump.uv);
    if (bump.texture.upscale == Upscale::taps && bump.texture.wrap == Wrap::clamp)
        table.complain("upscale", "is \"taps\", which repeats: wrap must not be \"clamp\"");
    read_weight(table, layer);
    layer.bump = bump;
}

void read_height_channel(Table& table, Layer& layer) {
    HeightChannelLayer bump;
    table.require("channel");
    table.read("channel", bump.channel);
    read_weight_without_levels(table, layer);
    layer.bump = bump;
}

void read_derivative_map(Table& table, Layer& layer) {
    DerivativeMapLayer bump;
    read_texture_file(table, bump.texture);
    read_green(table, bump.texture);
    read_slope_encoding(table, bump.texture);
    table.choose("bump_scale", bump.auto_scale, {{"metres", false}, {"auto", true}});
    read_mapped(table, bump.texture, bump.uv);
    read_weight(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
