#include "layers/common.h"

namespace wrinkle {

namespace {

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<ConstantLayer>(layer);
    table.require("gradient");
    table.read("gradient", bump.gradient);
    scene::read_project(table, layer);
    scene::read_weight_without_levels(table, layer);
    layer.bump = bump;
}

std::string emit(LayerText& at) {
    at.section.operations += 6;
    return at.volume(at.vector("gradient", [](const Layer& l) { return std::get<ConstantLayer>(l.bump).gradient; }));
}

}  // namespace

const LayerKind& layers::constant() {
    static constexpr LayerKind row{.name = ConstantLayer::kind, .read = read, .emit = emit, .once_a_pixel = true};
    return row;
}

}  // namespace wrinkle
