#include <fmt/format.h>

#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kTaps = 240;  // expected operations

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<HeightMapLayer>(layer);
    scene::read_texture_of(table, bump.texture, Content::height);
    scene::read_any_upscale(table, bump.texture);
    scene::read_mapped(table, bump.texture, bump.uv);
    if (bump.texture.upscale == Upscale::taps && bump.texture.wrap == Wrap::clamp)
        table.complain("upscale", "is \"taps\", which repeats: wrap must not be \"clamp\"");
    scene::read_weight(table, layer);
    layer.bump = bump;
}

std::string emit(LayerText& at) {
    const auto& l = std::get<HeightMapLayer>(at.layer.bump);
    if (l.texture.upscale != Upscale::taps) {
        const std::string text = at.textured(l.texture);
        return text + at.slopes("scale_dependent", "c.dx, c.dy, slope");
    }
    if (l.texture.wrap == Wrap::clamp) throw Error(at.who + ": upscale = \"taps\" repeats; wrap must not be \"clamp\"");
    at.section.operations += kTaps;
    const std::string text =
        at.located(l.texture, TexelKind::height) +
        fmt::format("        wr_vec2 dh = wr_height_taps(t, c.st, c.dx, c.dy, {});\n", at.lod("c.dx", "c.dy"));
    return text + at.slopes("from_screen_slope", "dh");
}

}  // namespace

const LayerKind& layers::height_map() {
    static constexpr LayerKind row = layers::slopes_on_uv(HeightMapLayer::kind, read, emit);
    return row;
}

}  // namespace wrinkle
