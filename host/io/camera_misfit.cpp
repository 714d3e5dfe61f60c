#include "io/camera_misfit.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/median.h"
#include "io/camera_placing.h"
#include "io/solve_camera.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// The key of the scene that would fit in the place of the one it has; empty: none.
std::string other_axis(const CameraSource& source, Size display, double pixel_aspect,
                       std::span<const PositionSample> samples) {
    if (!source.look_at) return "";
    const auto fits = [&](const CameraSource::LookAt& at) {
        return reprojection_residual(camera_looking(at, display, pixel_aspect), display, samples).median <=
               source.max_residual;
    };
    auto other = *source.look_at;
    if (other.lens) {
        for (const auto& [fit, name] :
             {std::pair{Lens::Fit::horizontal, "horizontal"}, {Lens::Fit::vertical, "vertical"}}) {
            other.lens->fit = fit;
            if (fits(other)) return fmt::format("fit = \"{}\"", name);
        }
        return "";
    }
    std::swap(other.fov_x, other.fov_y);
    return !fits(other) ? "" : other.fov_x > 0 ? "fov_x" : "fov_y";
}

/// How positions lie about the pixels that a camera projects them to.
struct Scatter {
    bool at_random = false;  ///< neighbours are off in different ways
    double roundness = 0;    ///< of the cloud of offsets: its narrow side by its wide one
};

Scatter scatter_of(const Camera& camera, Size display, std::span<const PositionSample> samples) {
    std::vector<double> off, apart;
    std::vector<std::array<double, 2>> offsets;
    for (const auto& sample : samples)
        if (const auto pixel = project(camera, display, sample.position))
            offsets.push_back({(*pixel)[0] - sample.x, (*pixel)[1] - sample.y});
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
        off.push_back(std::hypot(offsets[i][0], offsets[i][1]));
        apart.push_back(std::hypot(offsets[i + 1][0] - offsets[i][0], offsets[i + 1][1] - offsets[i][1]));
    }
    const double usual = median(off);
    double xx = 0, xy = 0, yy = 0;
    for (const auto& [x, y] : offsets) {
        if (std::hypot(x, y) > 4 * usual) continue;  // edges
        xx += x * x, xy += x * y, yy += y * y;
    }
    const double mean = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
    constexpr double alike = 0.7;  // offsets at random differ by 1.4 times their size
    return {median(apart) > alike * usual, mean > 0 ? std::sqrt(std::max(mean - half, 0.0) / (mean + half)) : 0};
}

}  // namespace

std::string explain_misfit(const CameraSource& source, const Camera& camera, Size display, double pixel_aspect,
                           std::span<const PositionSample> samples) {
    if (const auto key = other_axis(source, display, pixel_aspect, samples); !key.empty())
        return fmt::format("{} fits: the field of view looks like that of the picture's other side", key);
    std::optional<Camera> solved;
    try {
        solved = solve_camera(samples, display, pixel_aspect);
    } catch (const Error&) {}
    if (solved) {
        const double off = reprojection_residual(*solved, display, samples).median;
        if (off <= source.max_residual)
            return fmt::format(
                "it is another frame's camera, or stands elsewhere: the one that [camera] from = \"positions\" solves "
                "fits within {:.2g} pixel",
                off);
    }
    const Scatter scatter = scatter_of(solved.value_or(camera), display, samples);
    constexpr double round = 0.5;
    if (solved && scatter.at_random)
        return fmt::format(
            "no camera fits: positions are scattered about their pixels {}, as {} does it; render the data "
            "passes without, or allow more with max_residual",
            scatter.roundness > round ? "to all sides" : "along a line",
            scatter.roundness > round ? "depth of field" : "motion blur");
    return "is it the camera of this frame, and are the positions in world space?";
}

}  // namespace wrinkle::io
