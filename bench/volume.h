#pragma once

#include "record.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Value and gradient of a grid of size^3 voxels (`size` a multiple of 8), in one race with NanoVDB's C++. Samples
/// follow three walks: along an oblique plane with 0.2 and with 1.4 voxels a pixel, and at random points. Group
/// "volume".
void measure_volumes(const Device& device, int size, Run& run);

}  // namespace wrinkle::bench
