#pragma once

#include <filesystem>

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// A scene by each contender: fused, one kernel a layer, plain C++ where that knows every layer; and, for `layers`,
/// each layer alone above the empty scene. With seconds to build the kernels, and to take them from the cache.
void measure_scene(const Device& device, const std::filesystem::path& file, Size size, bool layers, Run& run);

}  // namespace wrinkle::bench
