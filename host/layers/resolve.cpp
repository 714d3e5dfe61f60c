#include "layers/common.h"

namespace wrinkle {

namespace {

void read(scene::Table&, Layer& layer) { layer.bump = ResolveLayer{}; }

}  // namespace

const LayerKind& layers::resolve() {
    static constexpr LayerKind row{.name = ResolveLayer::kind, .read = read, .ends_stage = true};
    return row;
}

}  // namespace wrinkle
