#include "scene/layer_readers.h"

namespace wrinkle::scene {

void read_normal_map(Table& table, Layer& layer) {
    NormalMapLayer bump;
    read_texture_file(table, bump.texture);
    read_green(table, bump.texture);
    read_mapped(table, bump.texture, bump.uv);
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
    read_upscale(table, bump.texture);
    read_mapped(table, bump.texture, bump.uv);
    read_weight(table, layer);
    layer.bump = bump;
}

void read_derivative_map(Table& table, Layer& layer) {
    DerivativeMapLayer bump;
    read_texture_file(table, bump.texture);
    read_green(table, bump.texture);
    table.choose("encoding", bump.texture.encoding,
                 {{"auto", Encoding::automatic}, {"signed", Encoding::sign}, {"unit", Encoding::unit}});
    table.choose("slopes", bump.texture.unit, {{"texel", SlopeUnit::texel}, {"texture", SlopeUnit::texture}});
    table.choose("bump_scale", bump.auto_scale, {{"metres", false}, {"auto", true}});
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
