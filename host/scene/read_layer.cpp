#include <fmt/format.h>

#include "base/names.h"
#include "scene/kinds.h"
#include "scene/layer_readers.h"

namespace wrinkle::scene {
namespace {

void read_constant(Table& table, Layer& layer) {
    ConstantLayer bump;
    table.require("gradient");
    table.read("gradient", bump.gradient);
    read_project(table, layer);
    read_weight_without_levels(table, layer);
    layer.bump = bump;
}

void read_resolve(Table&, Layer& layer) { layer.bump = ResolveLayer{}; }

/// A row a kind: its name and what reads its keys.
constexpr Kind<Layer> kinds[] = {
    {NormalMapLayer::kind, read_normal_map},
    {HeightMapLayer::kind, read_height_map},
    {HeightChannelLayer::kind, read_height_channel},
    {TriplanarLayer::kind, read_triplanar},
    {NoiseLayer::kind, read_noise},
    {DecalLayer::kind, read_decal},
    {DecalsLayer::kind, read_decals},
    {VolumeLayer::kind, read_volume},
    {ConstantLayer::kind, read_constant},
    {ParallaxLayer::kind, read_parallax},
    {ResolveLayer::kind, read_resolve},
    {ObjectNormalLayer::kind, read_object_normal},
    {DerivativeMapLayer::kind, read_derivative_map},
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
