#pragma once

#include "layout.h"

namespace wrinkle {

/// Depth at and beyond which a pixel shows no surface, the same as in kernels.
inline constexpr double kBackgroundDepth = WR_BACKGROUND_DEPTH;

}  // namespace wrinkle
