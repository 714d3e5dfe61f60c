#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/gbuffer_reader.h"
#include "io/residual.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// A frame's camera and how well it fits the frame.
struct FrameCamera {
    Camera camera;
    std::string origin;                ///< file name, or how the header was read
    std::optional<Residual> residual;  ///< nothing without positions to compare with
    std::optional<DepthKind> depth;    ///< what the depth plane holds, where position and depth both exist
    std::string hint;                  ///< what seems to be wrong where the residual is large
    bool depth_fits = true;            ///< false: depth is neither planar depth nor distance of these positions
    std::vector<std::string> doubts;   ///< what of the frame does not fit together, in sentences
};

/// FRAME.camera.json beside the frame, or the same without the frame's extension, if there is one: the camera of a
/// scene that names none.
std::optional<std::filesystem::path> camera_beside(const std::filesystem::path& frame);

/// Reads the camera of frame number `frame` from wherever `source` says, as one for all of the frame, overscan
/// included. Measures the residual, and leaves it to check_residual() to refuse a large one. Throws Error when the file
/// is missing or malformed, is for another aspect, or its matrices are no camera.
FrameCamera read_frame_camera(const CameraSource& source, const GBufferReader& reader, int frame = 0);

/// "within 0.002 pixel (median)"; how well a camera fits.
std::string describe_residual(const FrameCamera& camera);

/// Throws Error when the positions reproject farther than `max_residual` pixels (their median).
void check_residual(const FrameCamera& camera, double max_residual, const GBufferReader& reader);

/// Reads a camera and refuses one that does not fit the frame: read_frame_camera(), then check_residual().
Camera read_camera(const CameraSource& source, const GBufferReader& reader, int frame = 0);

}  // namespace wrinkle
