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

/// Every reading of worldToNDC, worldToScreen, worldToCamera and cameraTransform that makes a camera, the most usual
/// one first, for a picture of that aspect. Writers differ: some transpose these matrices, let y point up, keep the
/// aspect of the screen window, or write positions in camera space.
std::vector<HeaderCamera> header_cameras(const Metadata& header, double aspect, Writer writer);

/// The reading that fits the positions best. Without positions, the one with the squarest pixels and the most centred
/// axis that agrees best with worldToCamera. Nothing when the header has no camera.
std::optional<HeaderCamera> best_header_camera(const Metadata& header, Size size, double pixel_aspect, Writer writer,
                                               std::span<const PositionSample> samples);

/// The camera of a world-to-clip matrix; nothing when it is no camera's. Only the rows x, y and w are used: the depth
/// row is replaced by one of our own.
std::optional<Camera> camera_of_clip(const Mat4& world_to_clip);

}  // namespace wrinkle::io
