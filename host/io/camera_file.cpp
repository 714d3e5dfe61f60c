#include "io/camera_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "io/camera_check.h"
#include "io/camera_json.h"
#include "io/frame_path.h"
#include "io/header_camera.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

std::string why_no_camera(const Metadata& header) {
    const auto is_bad = [](double value) { return !std::isfinite(value); };
    for (const char* name : {"worldToNDC", "worldToScreen", "worldToCamera", "cameraTransform"})
        if (const auto matrix = header.matrix(name))
            if (std::ranges::any_of(*matrix, [&](const auto& row) { return std::ranges::any_of(row, is_bad); }))
                return fmt::format("{} holds numbers that are not finite", name);
    for (const char* name : {"worldToNDC", "worldToScreen"})
        if (header.matrix(name)) return fmt::format("{} is no projection of the world onto the picture", name);
    if (header.matrix("worldToCamera") || header.matrix("cameraTransform"))
        return "where it stands, but neither worldToNDC nor a field of view";
    return "neither worldToNDC, worldToCamera nor cameraTransform";
}

FrameCamera camera_of_header(const GBufferReader& reader, std::span<const PositionSample> samples) {
    const auto& header = reader.metadata();
    if (auto best = io::best_header_camera(header, reader.size(), reader.roles().writer, samples)) {
        return {best->camera, "header: " + best->reading, {}, {}};
    }
    throw Error(
        fmt::format("{}: the header has no camera: {}; give [camera] file, view and proj, or eye, target and fov",
                    reader.path().string(), why_no_camera(header)));
}

FrameCamera camera_of(const CameraSource& source, const GBufferReader& reader, int frame,
                      std::span<const PositionSample> samples) {
    const auto size = reader.size();
    if (!source.file.empty()) {
        const auto file = frame_path(source.file, frame);
        return {io::read_camera_json(file, size), file.string(), {}, {}};
    }
    if (source.exr) return camera_of_header(reader, samples);
    if (source.inline_camera)
        return {io::checked_camera(*source.inline_camera, "[camera]"), "view and proj of the scene", {}, {}};
    if (source.look_at) {
        const auto& [eye, target, up, fov_y] = *source.look_at;
        const double aspect = static_cast<double>(size.width) / size.height;
        return {Camera::look_at(eye, target, up, fov_y, aspect), "eye and target of the scene", {}, {}};
    }
    throw Error("the scene has no camera; give [camera] file, from = \"exr\", view and proj, or eye, target and fov");
}

}  // namespace

FrameCamera read_frame_camera(const CameraSource& source, const GBufferReader& reader, int frame) {
    const auto samples = sample_positions(reader);
    auto result = camera_of(source, reader, frame, samples);
    if (!samples.empty()) {
        result.residual = reprojection_residual(result.camera, reader.size(), samples);
        result.depth = measure_depth_kind(result.camera, samples);
    }
    return result;
}

void check_residual(const FrameCamera& camera, double max_residual, const GBufferReader& reader) {
    if (!camera.residual || camera.residual->median <= max_residual) return;
    throw Error(fmt::format(
        "the camera ({}) does not fit {}: positions reproject {:.3g} pixels away (median of {}; "
        "[camera] max_residual = {} allows less); is it the camera of this frame, and are the "
        "positions in world space?",
        camera.origin, reader.path().string(), camera.residual->median, camera.residual->count, max_residual));
}

Camera read_camera(const CameraSource& source, const GBufferReader& reader, int frame) {
    const auto result = read_frame_camera(source, reader, frame);
    check_residual(result, source.max_residual, reader);
    return result.camera;
}

}  // namespace wrinkle
