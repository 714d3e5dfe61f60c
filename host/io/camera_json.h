#pragma once

#include <filesystem>
#include <optional>

#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Reads {"width", "height", "view", "proj"}; the matrices are rows and act on column vectors. `frame_size`: the frame
/// it must fit in aspect.
Camera read_camera_json(const std::filesystem::path& file, Size frame_size);

/// "width" and "height", where they are there.
std::optional<Size> camera_json_size(const std::filesystem::path& file);

}  // namespace wrinkle::io
