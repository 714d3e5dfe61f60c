#pragma once

#include <filesystem>
#include <optional>

#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Reads {"width", "height", "view", "proj"}. Matrices are lists of rows and act on column vectors. Throws Error when
/// the file is malformed, when it is no camera, or when its aspect is not that of `frame_size`.
Camera read_camera_json(const std::filesystem::path& file, Size frame_size);

/// "width" and "height" of a camera file, if it has them.
std::optional<Size> camera_json_size(const std::filesystem::path& file);

}  // namespace wrinkle::io
