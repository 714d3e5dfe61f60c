#include "layers/common.h"

namespace wrinkle {

namespace {

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<HeightChannelLayer>(layer);
    table.require("channel");
    table.read("channel", bump.channel);
    scene::read_weight_without_levels(table, layer);
    layer.bump = bump;
}

std::string emit(LayerText& at) {
    const std::string plane = "channel:" + std::get<HeightChannelLayer>(at.layer.bump).channel;
    at.emitter.need(at.who, {plane});
    return emit_height_taps(at.emitter, plane, at.section) + at.slopes("from_screen_slope", "dh");
}

}  // namespace

const LayerKind& layers::height_channel() {
    static constexpr LayerKind row{.name = HeightChannelLayer::kind,
                                   .read = read,
                                   .emit = emit,
                                   .once_a_pixel = true,
                                   .variants = layers::standard_and_exact};
    return row;
}

}  // namespace wrinkle
