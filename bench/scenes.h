#pragma once

#include <filesystem>

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Measures a scene fused, as one kernel a layer, and in plain C++ where every layer has such a form; with `layers`,
/// also what each layer alone adds to the time of an empty scene. Records the seconds to build the kernels, and to take
/// them from the cache.
void measure_scene(const Device& device, const std::filesystem::path& file, Size size, bool layers, Run& run);

}  // namespace wrinkle::bench
