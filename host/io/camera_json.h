#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Reads {"width", "height", "view", "proj"}; the matrices are rows and act on column vectors. `frame_size`: the frame
/// it must fit in aspect.
Camera read_camera_json(const std::filesystem::path& file, Size frame_size);

/// "width" and "height", where they are there.
std::optional<Size> camera_json_size(const std::filesystem::path& file);

/// Makes the last row of a view matrix 0 0 0 1 where it is that but for rounding; else false.
bool settle_last_row(Mat4& view);

/// The camera, the last row of its view settled. Throws Error, beginning with `name`, unless the entries are finite,
/// view is rigid and proj can be inverted.
Camera checked_camera(Camera camera, const std::string& name);

}  // namespace wrinkle::io
