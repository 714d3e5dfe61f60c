#pragma once

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// The machine's ceilings, by a copy, a triad and chains of fma; and resolve, the pass that comes closest to them, by
/// the kernel and in plain C++. All in one race.
void measure_memory(const Device& device, Size size, Run& run);

}  // namespace wrinkle::bench
