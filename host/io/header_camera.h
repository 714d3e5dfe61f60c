#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/gbuffer_roles.h"
#include "io/metadata.h"
#include "io/residual.h"
#include "wrinkle/camera.h"

namespace wrinkle::io {

/// One way to read the matrices of an EXR header.
struct HeaderCamera {
    Camera camera;
    std::string reading;  ///< "worldToNDC, row vectors, (0,0) top left"
};

/// Every reading of worldToNDC, worldToScreen, worldToCamera or cameraTransform that makes a camera, the most usual
/// first: writers transpose, turn y up, keep the screen window's aspect or put positions in camera space.
std::vector<HeaderCamera> header_cameras(const Metadata& header, Size size, Writer writer);

/// The reading that fits the positions best; without positions the one whose pixels are square, whose axis is centred
/// and which agrees with the camera matrix. Nothing when the header has no camera.
std::optional<HeaderCamera> best_header_camera(const Metadata& header, Size size, Writer writer,
                                               std::span<const PositionSample> samples);

/// Camera of the rows x, y and w of world-to-clip; nothing when they make no camera. The depth row is made anew.
std::optional<Camera> camera_of_clip(const Mat4& world_to_clip);

}  // namespace wrinkle::io
