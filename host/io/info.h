#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/camera_file.h"
#include "io/gbuffer_roles.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// A role's values over the whole frame.
struct RoleStats {
    std::string role;
    std::vector<std::string> channels;
    double min = 0, max = 0;    ///< over the components of all valid pixels; 0 when there are no valid ones
    std::uint64_t invalid = 0;  ///< pixels with NaN or Inf; normals of length 0; depths outside (0, 1e9)
};

/// What `wrinkle info` prints of the frame itself; tools/readiness.h says what it is good for.
struct GBufferInfo {
    std::filesystem::path file;
    RoleMap roles;  ///< writer, plane to channel, depth kind, cryptomatte layer
    Size size;
    int parts = 0;
    std::vector<std::string> channels;
    bool packed_normals = false;
    std::vector<RoleStats> stats;
    std::optional<FrameCamera> camera;
    std::string camera_problem;  ///< why there is no camera
    std::vector<std::string> cryptomatte_names;

    std::uint64_t pixels() const { return std::uint64_t{size.width} * size.height; }
};

/// Reads the whole frame. Without `camera`, it tries FILE.camera.json beside the frame, then the frame's header. Throws
/// Error when the frame, or the camera that was given, cannot be read.
GBufferInfo gather_info(const GBufferSource& source, const std::optional<CameraSource>& camera = std::nullopt,
                        int frame = 0);

}  // namespace wrinkle
