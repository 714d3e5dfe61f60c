#include "io/camera_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "io/camera_check.h"
#include "io/camera_json.h"
#include "io/camera_misfit.h"
#include "io/camera_placing.h"
#include "io/channel_names.h"
#include "io/frame_path.h"
#include "io/header_camera.h"
#include "io/solve_camera.h"
#include "io/surface_check.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

FrameCamera seen_by(const Camera& camera, std::string origin) {
    FrameCamera found;
    found.camera = camera, found.origin = std::move(origin);
    return found;
}

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
    if (auto best = io::best_header_camera(header, reader.window().display, reader.pixel_aspect(),
                                           reader.roles().writer, samples)) {
        return seen_by(best->camera, "header: " + best->reading);
    }
    throw Error(
        fmt::format("{}: the header has no camera: {}; give [camera] file, from = \"positions\", view and proj, or "
                    "eye, target and fov",
                    reader.path().string(), why_no_camera(header)));
}

FrameCamera camera_of_positions(const GBufferReader& reader, std::span<const PositionSample> samples) {
    const auto fail = [&](std::string_view why) {
        throw Error(fmt::format("{}: the camera cannot be solved from the positions: {}", reader.path().string(), why));
    };
    if (!reader.has_role("position"))
        fail("the frame has no position pass; channels found: " + io::describe_channels(reader.channels()));
    try {
        return seen_by(io::solve_camera(samples, reader.window().display, reader.pixel_aspect()),
                       "solved from the positions");
    } catch (const Error& error) { fail(error.what()); }
    return {};
}

/// The camera of a scene that names none.
FrameCamera camera_found(const GBufferReader& reader, double max_residual, std::span<const PositionSample> samples) {
    const Size size = reader.window().display;
    if (const auto beside = camera_beside(reader.path()))
        return seen_by(io::read_camera_json(*beside, size), beside->string());
    std::optional<io::HeaderCamera> best =
        io::best_header_camera(reader.metadata(), size, reader.pixel_aspect(), reader.roles().writer, samples);
    const bool fits =
        best && (samples.empty() || reprojection_residual(best->camera, size, samples).median <= max_residual);
    if (fits || (best && !reader.has_role("position"))) return seen_by(best->camera, "header: " + best->reading);
    if (reader.has_role("position")) return camera_of_positions(reader, samples);
    throw Error(fmt::format(
        "{}: no camera: there is no {}.camera.json, the header has none ({}), and without a position pass none can be "
        "solved; give [camera] file, view and proj, or eye, target and fov",
        reader.path().string(), reader.path().filename().string(), why_no_camera(reader.metadata())));
}

FrameCamera camera_of(const CameraSource& source, const GBufferReader& reader, int frame,
                      std::span<const PositionSample> samples) {
    const Size size = reader.window().display;
    if (!source.file.empty()) {
        const auto file = frame_path(source.file, frame);
        return seen_by(io::read_camera_json(file, size), file.string());
    }
    if (source.exr) return camera_of_header(reader, samples);
    if (source.positions) return camera_of_positions(reader, samples);
    if (source.inline_camera)
        return seen_by(io::checked_camera(*source.inline_camera, "[camera]"), "view and proj of the scene");
    if (source.look_at)
        return seen_by(io::camera_looking(*source.look_at, size, reader.pixel_aspect()), "eye and target of the scene");
    return camera_found(reader, source.max_residual, samples);
}

void check_depth(const GBufferReader& reader, std::span<const PositionSample> samples, FrameCamera& result) {
    constexpr double bound = 0.02;  // filters and half floats stay below a tenth of it
    const double off = depth_misfit(result.camera, samples);
    if (off <= bound) return;
    result.depth_fits = false;
    result.doubts.push_back(
        fmt::format("depth ({}) does not fit the positions: it is off by {:.0f}% (median), taken as planar depth or as "
                    "distance. Positions are used in its place, unless [gbuffer] geometry = \"depth\"; is it "
                    "normalised, negative, or in another unit?",
                    reader.roles().channel_of.find("depth")->second, 100 * off));
}

/// A camera may fit most of a frame, a plane for one, and not the rest.
void doubt_outliers(FrameCamera& result) {
    constexpr double far = 2, times = 10;  // pixels; medians
    const Residual& residual = *result.residual;
    if (!(residual.p99 > std::max(far, times * residual.median))) return;
    result.doubts.push_back(fmt::format(
        "the camera fits half of the positions within {:.2g} pixels, but 1% of them are {:.3g} pixels or more "
        "from where it sees them: averages at edges, something that moves, or pixels that are not square",
        residual.median, residual.p99));
}

}  // namespace

std::optional<std::filesystem::path> camera_beside(const std::filesystem::path& frame) {
    for (auto beside : {frame.string() + ".camera.json",
                        std::filesystem::path(frame).replace_extension().string() + ".camera.json"}) {
        std::error_code code;
        if (std::filesystem::exists(beside, code)) return beside;
    }
    return std::nullopt;
}

FrameCamera read_frame_camera(const CameraSource& source, const GBufferReader& reader, int frame) {
    const auto samples = sample_positions(reader);
    auto result = camera_of(source, reader, frame, samples);
    const Size display = reader.window().display;
    bool fits = true;
    if (!samples.empty()) {
        result.residual = reprojection_residual(result.camera, display, samples);
        result.depth = measure_depth_kind(result.camera, samples);
        fits = result.residual->median <= source.max_residual;
        if (fits) doubt_outliers(result);
        if (fits)
            check_depth(reader, samples, result);
        else
            result.hint = io::explain_misfit(source, result.camera, display, reader.pixel_aspect(), samples);
    }
    result.camera = io::windowed(result.camera, reader.window(), reader.size());
    if (!fits) return result;
    if (auto misfit = io::depth_misfit(reader); !misfit.empty()) result.doubts.push_back(std::move(misfit));
    if (auto misfit = io::normals_misfit(reader, result.camera); !misfit.empty())
        result.doubts.push_back(std::move(misfit));
    return result;
}

std::string describe_residual(const FrameCamera& camera) {
    if (!camera.residual) return "no positions to check it against";
    return fmt::format("positions reproject within {:.3g} pixel (median), {:.3g} (99%)", camera.residual->median,
                       camera.residual->p99);
}

void check_residual(const FrameCamera& camera, double max_residual, const GBufferReader& reader) {
    if (!camera.residual || camera.residual->median <= max_residual) return;
    throw Error(
        fmt::format("the camera ({}) does not fit {}: positions reproject {:.3g} pixels away (median of {}; "
                    "[camera] max_residual = {} allows less); {}",
                    camera.origin, reader.path().string(), camera.residual->median, camera.residual->count,
                    max_residual, camera.hint));
}

Camera read_camera(const CameraSource& source, const GBufferReader& reader, int frame) {
    const auto result = read_frame_camera(source, reader, frame);
    check_residual(result, source.max_residual, reader);
    return result.camera;
}

}  // namespace wrinkle
