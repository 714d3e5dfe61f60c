#pragma once

#include "report.h"
#include "wrinkle/device.h"
#include "wrinkle/scene.h"

namespace wrinkle::bench {

/// The demo scene and each of its layers alone: fused, one kernel a layer, plain C++. Fills rows, layers and builds.
void measure_demo(const Device& device, const Scene& scene, const BenchFrame& frame, Report& report);

/// Copy and resolve, the memory ceiling and the pass that comes closest to it.
void measure_memory(const Device& device, Report& report);

}  // namespace wrinkle::bench
