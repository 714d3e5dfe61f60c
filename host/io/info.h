#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/camera_file.h"
#include "io/gbuffer_roles.h"
#include "io/uv_digits.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// A role's values over the rows that were measured.
struct RoleStats {
    std::string role;
    std::vector<std::string> channels;
    double min = 0, max = 0;    ///< over the components of all valid pixels; 0 when there are no valid ones
    std::uint64_t invalid = 0;  ///< pixels with NaN or Inf; normals of length 0; depths outside (0, 1e9)
    std::uint64_t mixed = 0;    ///< of object: pixels whose number is not whole
};

/// What `wrinkle info` prints of the frame itself; tools/readiness.h says what it is good for.
struct GBufferInfo {
    std::filesystem::path file;
    RoleMap roles;  ///< writer, plane to channel, depth kind, cryptomatte layer
    Size size;
    int parts = 0;
    std::vector<std::string> channels;
    std::vector<ChannelType> types;  ///< of the channels
    std::vector<std::string> views;
    std::string view;  ///< the one that is read
    bool packed_normals = false;
    io::UvDigits uv_digits = io::UvDigits::enough;
    io::ObjectStorage objects = io::ObjectStorage::single;
    std::uint64_t measured =
        0;  ///< pixels whose values are in `stats`: all, or those of rows spread over a large frame
    std::vector<RoleStats> stats;
    std::optional<FrameCamera> camera;
    std::string camera_problem;  ///< why there is no camera, or why it is refused
    std::vector<std::string> cryptomatte_names;
    std::string cryptomatte_problem;          ///< why its ids cannot be read
    std::vector<std::string> light_pictures;  ///< layers that show one light or a group of them, by their names

    std::uint64_t pixels() const { return std::uint64_t{size.width} * size.height; }
};

/// Reads the frame, of a large one rows that are spread over it. Without `camera`, it takes the one that scenes without
/// [camera] get. Throws Error when the frame, or the camera that was given, cannot be read.
GBufferInfo gather_info(const GBufferSource& source, const std::optional<CameraSource>& camera = std::nullopt,
                        int frame = 0);

}  // namespace wrinkle
