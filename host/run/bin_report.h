#pragma once

#include "resources/decal_bins.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// What the bins of a scene's tables of decals hold on its frame `number`, all of it at once.
BinReport bin_report(const Device& device, const Scene& scene, const Frame& frame, int number = 0);

}  // namespace wrinkle
