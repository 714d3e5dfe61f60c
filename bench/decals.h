#pragma once

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Tables of 1,000 to 100,000 decals, small enough that each table covers every pixel equally often. Measures the whole
/// pass, its binning alone, what the host does for a new camera, and plain C++ given the same lists, all in one race.
/// Group "decals". `quick`: only the short tables, without plain C++.
void measure_decals(const Device& device, Size size, bool quick, Run& run);

}  // namespace wrinkle::bench
