#include "io/header_camera.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/imath.h"
#include "base/names.h"
#include "io/camera_check.h"

namespace wrinkle::io {
namespace {

/// A matrix that acts on column vectors, as all of ours do. Those of EXR headers act on row vectors, but some writers
/// store the transpose.
Mat4 on_columns(const Mat4& m, bool row_vectors) { return row_vectors ? to_array(to_imath(m).transposed()) : m; }

/// A convention for normalised device coordinates.
struct Window {
    bool unit;  ///< they span [0,1]; else [-1,1]
    bool y_down;
    bool aspect;  ///< only the shorter side of the picture spans that; the longer one spans more
};

Mat4 to_clip(Mat4 ndc, Window window, double aspect) {
    for (std::size_t i = 0; i < 4; ++i) {
        const double w = ndc[3][i];
        if (window.unit) ndc[0][i] = 2 * ndc[0][i] - w, ndc[1][i] = 2 * ndc[1][i] - w;
        if (window.y_down) ndc[1][i] = -ndc[1][i];
        if (window.aspect) (aspect > 1 ? ndc[0][i] : ndc[1][i]) *= aspect > 1 ? 1 / aspect : aspect;
    }
    return ndc;
}

/// All conventions; the one that this writer usually means comes first.
std::vector<Window> windows(const std::string& name, Writer writer) {
    const bool ndc = name == "worldToNDC";
    std::vector<Window> result;
    for (const bool unit : {ndc, !ndc})
        for (const bool y_down : {ndc && writer != Writer::pbrt, !(ndc && writer != Writer::pbrt)})
            for (const bool aspect : {false, true}) result.push_back({unit, y_down, aspect});
    return result;
}

void add_projection(std::vector<HeaderCamera>& found, const std::string& name, const Mat4& world_to_ndc, bool rows,
                    bool camera_space, double aspect, Writer writer) {
    for (const auto window : windows(name, writer)) {
        const auto camera = camera_of_clip(to_clip(world_to_ndc, window, aspect));
        if (!camera) continue;
        found.push_back(
            {*camera,
             fmt::format("{}, {}, {} {}{}{}", name, rows ? "row vectors" : "transposed",
                         window.unit ? "(0,0)" : "(-1,-1)", window.y_down ? "top left" : "bottom left",
                         window.aspect ? ", screen window" : "", camera_space ? ", positions in camera space" : "")});
    }
}

void add_projections(std::vector<HeaderCamera>& found, const Metadata& header, double aspect, Writer writer) {
    const bool usual_rows = writer != Writer::pbrt;
    for (const std::string name : {"worldToNDC", "worldToScreen"}) {
        const auto matrix = header.matrix(name);
        if (!matrix) continue;
        for (const bool rows : {usual_rows, !usual_rows}) {
            add_projection(found, name, on_columns(*matrix, rows), rows, false, aspect, writer);
        }
    }
    // pbrt's positions and normals are in camera space unless told otherwise.
    const auto world_to_camera = header.matrix("worldToCamera"), world_to_ndc = header.matrix("worldToNDC");
    if (!world_to_camera || !world_to_ndc) return;
    for (const bool rows : {usual_rows, !usual_rows}) {
        const auto back = inverse_or_nothing(on_columns(*world_to_camera, rows));
        if (!back) continue;
        add_projection(found, "worldToNDC", multiply(on_columns(*world_to_ndc, rows), *back), rows, true, aspect,
                       writer);
    }
}

/// The header's field of view in radians. Values above pi can only be degrees.
std::optional<double> field_of_view(const Metadata& header) {
    for (const auto& name : header.names()) {
        const auto value = header.number(name);
        if (!value || !contains_ignoring_case(name, "fov") || !(*value > 0 && *value < 180)) continue;
        return *value > std::numbers::pi ? *value * std::numbers::pi / 180 : *value;
    }
    return std::nullopt;
}

void add_placements(std::vector<HeaderCamera>& found, const Metadata& header, double aspect) {
    const auto fov = field_of_view(header);
    if (!fov) return;
    const double focal = 1 / std::tan(*fov / 2);
    for (const std::string name : {"worldToCamera", "cameraTransform"}) {
        const auto matrix = header.matrix(name);
        if (!matrix) continue;
        const bool camera_to_world = name == "cameraTransform";  // as V-Ray means it
        for (const bool rows : {true, false})
            for (const bool usual : {true, false})
                for (const bool forward_usual : {true, false})
                    for (const bool horizontal : {true, false}) {
                        const bool inverted = usual == camera_to_world;
                        const bool back_is_z = forward_usual == camera_to_world;
                        auto view = std::optional(on_columns(*matrix, rows));
                        if ((*view)[3] != std::array<double, 4>{0, 0, 0, 1}) continue;  // it must be the transpose
                        if (inverted) view = inverse_or_nothing(*view);
                        if (!view) continue;
                        const double fx = horizontal ? focal : focal / aspect, fy = horizontal ? focal * aspect : focal;
                        const double z = back_is_z ? -1 : 1;
                        const Mat4 proj{{{fx, 0, 0, 0}, {0, fy, 0, 0}, {0, 0, z, 0}, {0, 0, z, 0}}};
                        const auto camera = camera_of_clip(multiply(proj, *view));
                        if (!camera) continue;
                        found.push_back(
                            {*camera, fmt::format("{}, {}, {}, looks along {}z, {} field of view", name,
                                                  rows ? "row vectors" : "transposed",
                                                  inverted ? "camera to world" : "world to camera",
                                                  back_is_z ? "-" : "+", horizontal ? "horizontal" : "vertical")});
                    }
    }
}

/// How unusual a camera is, to choose one when there are no positions to check it with: how far its pixels are from
/// square, its axis from the picture's centre, its view from the header's worldToCamera. 0 for an ordinary camera.
double oddness(const Camera& camera, const Metadata& header, double aspect) {
    const auto& p = camera.proj;
    double odd = std::abs(std::log(p[0][0] * aspect / p[1][1])) + std::abs(p[0][2]) + std::abs(p[1][2]) +
                 std::abs(p[1][0] / p[1][1]);
    if (const auto matrix = header.matrix("worldToCamera")) {
        double best = std::numeric_limits<double>::infinity();
        for (const bool rows : {true, false}) {
            const auto view = on_columns(*matrix, rows);
            double apart = 0;  // the header's camera looks along +z
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 4; ++j)
                    apart += std::abs(camera.view[i][j] - (i == 2 ? -1 : 1) * view[i][j]);
            best = std::min(best, apart);
        }
        odd += best;
    }
    return odd;
}

}  // namespace

std::vector<HeaderCamera> header_cameras(const Metadata& header, double aspect, Writer writer) {
    std::vector<HeaderCamera> found;
    add_projections(found, header, aspect, writer);
    if (found.empty()) add_placements(found, header, aspect);
    return found;
}

std::optional<HeaderCamera> best_header_camera(const Metadata& header, Size size, double pixel_aspect, Writer writer,
                                               std::span<const PositionSample> samples) {
    const double aspect = pixel_aspect * size.width / size.height;
    // A less usual reading must be better than this share of the best one, and by more than so many pixels.
    constexpr double clearly = 0.9, noise = 1e-3;
    std::optional<HeaderCamera> best;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& candidate : header_cameras(header, aspect, writer)) {
        const double misfit = samples.empty() ? oddness(candidate.camera, header, aspect)
                                              : reprojection_residual(candidate.camera, size, samples).median;
        if (best && !(misfit < clearly * least && misfit < least - noise)) continue;
        best = candidate;
        least = misfit;
    }
    return best;
}

}  // namespace wrinkle::io
