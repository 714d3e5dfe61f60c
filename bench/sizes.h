#pragma once

#include <filesystem>

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Measures the fused scene at each size (group "size"), in bands, so that memory does not grow with the frame. Each
/// size takes turns, band by band, with a frame of 3840 x 2160, whose times are recorded too (group "turns").
void measure_sizes(const Device& device, const std::filesystem::path& file, const std::vector<Size>& sizes, Run& run);

}  // namespace wrinkle::bench
