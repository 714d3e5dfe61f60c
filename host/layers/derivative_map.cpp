#include <fmt/format.h>

#include "layers/common.h"

namespace wrinkle {

namespace {

constexpr double kTextureMetres = 60;  // expected operations

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<DerivativeMapLayer>(layer);
    scene::read_texture_of(table, bump.texture, Content::slope);
    scene::read_green(table, bump.texture);
    scene::read_slope_encoding(table, bump.texture);
    table.choose("bump_scale", bump.auto_scale, {{"metres", false}, {"auto", true}});
    scene::read_mapped(table, bump.texture, bump.uv);
    scene::read_weight(table, layer);
    layer.bump = bump;
}

std::string emit(LayerText& at) {
    const auto& l = std::get<DerivativeMapLayer>(at.layer.bump);
    std::string text = at.textured(l.texture);
    if (l.auto_scale) {
        text += fmt::format(
            "        wr_real metres = wr_texture_metres(dp_dx, dp_dy, c.dx, c.dy){};\n"
            "        slope = wr_scale(slope, metres);\n",
            l.texture.unit == SlopeUnit::texel ? " / wr_texels_across(t)" : "");
        if (at.tells_spread()) text += "        lost = wr_scale(lost, metres * metres);\n";
        at.section.operations += kTextureMetres;
    }
    return text + at.slopes("scale_dependent", "c.dx, c.dy, slope");
}

}  // namespace

const LayerKind& layers::derivative_map() {
    static constexpr LayerKind row = layers::slopes_on_uv(DerivativeMapLayer::kind, read, emit);
    return row;
}

}  // namespace wrinkle
