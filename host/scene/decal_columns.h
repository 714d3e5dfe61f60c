#pragma once

#include "scene/row_kind.h"
#include "wrinkle/decal_layers.h"

namespace wrinkle::scene {

/// `textures`: how many textures rows may name.
RowKind<Projector> decal_rows(std::size_t textures);

}  // namespace wrinkle::scene
