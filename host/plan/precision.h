#pragma once

#include <vector>

#include "wrinkle/precision.h"

namespace wrinkle {

/// The variants of positions and screen derivatives; those of a layer are its kind's (scene/layer_kind.h).
std::vector<Precision> geometry_precisions();

/// The variant of `ladder` that serves `wanted`.
Precision served(const std::vector<Precision>& ladder, Precision wanted);

}  // namespace wrinkle
