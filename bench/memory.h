#pragma once

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Copy, triad, fma: the ceilings; and resolve, the pass that comes closest to them, beside plain C++. In one race.
void measure_memory(const Device& device, Size size, Run& run);

}  // namespace wrinkle::bench
