#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Reads {"width", "height", "view", "proj"}. Matrices are lists of rows and act on column vectors. Throws Error when
/// the file is malformed, when it is no camera, or when its aspect is not that of `frame_size`.
Camera read_camera_json(const std::filesystem::path& file, Size frame_size);

/// "width" and "height" of a camera file, if it has them.
std::optional<Size> camera_json_size(const std::filesystem::path& file);

/// Sets the last row of a view matrix to 0 0 0 1 when it differs only by rounding. Returns false when it differs by
/// more.
bool settle_last_row(Mat4& view);

/// The camera, with the last row of its view set to exactly 0 0 0 1. Throws Error unless its numbers are finite, view
/// is rigid and proj can be inverted; the message begins with `name`.
Camera checked_camera(Camera camera, const std::string& name);

}  // namespace wrinkle::io
