#pragma once

#include <array>
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
/// What the normal's channels hold: world-space vectors as they are; the same as (n + 1) / 2; or vectors in camera
/// space, x to the right, y up. Automatic: by the header and by the values.
enum class NormalKind { automatic, sign, packed, camera };
enum class VDirection {
    automatic,
    up,
    down
};  ///< where the second texture coordinate grows to; automatic: by the writer

struct GBufferSource {
    std::filesystem::path file;  ///< may hold #### or %04d for the frame number, %V for the view
    std::map<std::string, std::string>
        roles;  ///< role (see wrinkle/gbuffer.h) to channel or layer name: overrides detection
    Geometry geometry = Geometry::automatic;  ///< automatic prefers depth, for its digits
    DepthKind depth = DepthKind::automatic;   ///< automatic: by the writer
    NormalKind normals = NormalKind::automatic;
    VDirection v = VDirection::automatic;
    std::string view{};   ///< of a stereo frame; empty: the first one, which is the file's default
    std::string layer{};  ///< view layer; empty: the one with most roles
    /// The picture, where another file has it: of the same size, or smaller by a whole factor; may hold the patterns of
    /// `file`.
    std::filesystem::path beauty_file{};
    std::string beauty_layer{};  ///< of that file; empty: the one that is called as pictures are
    bool overscan = false;       ///< what the data window holds around the picture belongs to the frame
};

/// A lens as cameras state it. Lengths in millimetres.
struct Lens {
    enum class Fit {
        automatic,
        horizontal,
        vertical
    };  ///< which side of the picture the sensor covers; automatic: the longer
    double focal = 50;
    std::array<double, 2> sensor{36, 24};
    Fit fit = Fit::automatic;
};

struct CameraSource {
    /// With nothing set: a camera file beside the frame, else its header, else its positions.
    std::filesystem::path file;           ///< JSON with view, proj (rows); may hold the frame pattern
    bool exr = false;                     ///< worldToCamera, worldToNDC (and their kin) of the G-buffer's header
    bool positions = false;               ///< solved from the position pass
    std::optional<Camera> inline_camera;  ///< matrices as given
    /// Set with `eye`, `target` and one of `fov_y`, `fov_x`, `lens`: aspect comes from the frame.
    struct LookAt {
        Vec3 eye{}, target{}, up{0, 0, 1};
        double fov_y = 0, fov_x = 0;  ///< radians; one of them, or neither with a lens
        std::optional<Lens> lens{};
        std::array<double, 2> shift{};  ///< of the picture to the right and up, in shares of its longer side
    };
    std::optional<LookAt> look_at;
    double max_residual = 0.5;  ///< pixels; a camera that reprojects positions worse than this is refused
};

}  // namespace wrinkle
