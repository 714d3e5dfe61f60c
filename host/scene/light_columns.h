#pragma once

#include "scene/row_kind.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {

RowKind<Light> light_rows();

}  // namespace wrinkle::scene
