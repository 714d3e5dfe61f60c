#pragma once

#include <optional>
#include <string>

#include "wrinkle/camera.h"

/// What makes two matrices a camera, wherever they were read.
namespace wrinkle::io {

/// What keeps `view` from being rigid, world to camera, as a sentence that begins with "view" goes on; or nothing.
/// Makes its last row 0 0 0 1 where it is that but for rounding.
std::string why_not_rigid(Mat4& view);

/// The inverse; nothing of a matrix that has none.
std::optional<Mat4> inverse_or_nothing(const Mat4& m);

/// The camera, the last row of its view settled. Throws Error, beginning with `name`, unless the entries are finite,
/// view is rigid and proj can be inverted.
Camera checked_camera(Camera camera, const std::string& name);

}  // namespace wrinkle::io
