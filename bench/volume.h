#pragma once

#include "record.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Value and gradient on a grid of size^3 voxels, a multiple of 8, against NanoVDB's C++ in the same run. Walks: 0.2
/// and 1.4 voxels a pixel along a plane askew to the grid, and points at random. Group "volume".
void measure_volumes(const Device& device, int size, Run& run);

}  // namespace wrinkle::bench
