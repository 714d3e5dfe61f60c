#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "wrinkle/camera.h"

/// Where the pixels of a scene come from, and who saw them.
///
///     scene.gbuffer.file = "shot.####.exr";
///     scene.gbuffer.roles["uv"] = "UVMap";
///     scene.camera.look_at = {.eye = {0, -5, 2}, .target = {0, 0, 0}, .fov_y = 0.9};
///
/// Threads: values, used as any other: read by several at once, or changed by one.
namespace [[gnu::visibility("default")]] wrinkle {

enum class Geometry { automatic, depth, position };
enum class DepthKind { automatic, planar, ray };

struct GBufferSource {
    std::filesystem::path file;  ///< may hold #### or %04d for the frame number
    std::map<std::string, std::string>
        roles;  ///< role (see wrinkle/gbuffer.h) to channel or layer name: overrides detection
    Geometry geometry = Geometry::automatic;  ///< automatic prefers depth, for its digits
    DepthKind depth = DepthKind::automatic;   ///< automatic: by the writer
};

struct CameraSource {
    std::filesystem::path file;           ///< JSON with view, proj (rows); may hold the frame pattern
    bool exr = false;                     ///< worldToCamera, worldToNDC (and their kin) of the G-buffer's header
    std::optional<Camera> inline_camera;  ///< matrices as given
    /// Set with `eye`, `target`, `fov`: aspect comes from the frame.
    struct LookAt {
        Vec3 eye{}, target{}, up{0, 0, 1};
        double fov_y = 0;
    };
    std::optional<LookAt> look_at;
    double max_residual = 0.5;  ///< pixels; a camera that reprojects positions worse than this is refused
};

}  // namespace wrinkle
