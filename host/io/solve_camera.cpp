#include "io/solve_camera.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/median.h"
#include "io/camera_fit.h"
#include "io/header_camera.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

constexpr std::size_t kFewest = 24;  // positions; 6 would do without noise
constexpr double kFlat = 1e-4;       // of a plane's extent: what rounding may lift its points
constexpr double kClearly = 1.1;     // a camera with more parameters must fit so many times better
constexpr double kWorthIt = 0.005;   // pixels, by which it must fit better
constexpr double kDoubt = 0.05;      // share of the focal length that may be open

/// The points, moved and scaled: point = scale * seen + centre.
struct Normalised {
    SeenPoints seen;
    Vector3d centre;
    double scale = 1;
    Matrix3d axes;  ///< columns: main axes of the points, the widest first
    bool flat = false;
};

Normalised normalised(std::span<const PositionSample> samples, Size size) {
    Normalised out;
    std::vector<double> values[3], lengths;
    for (const auto& sample : samples)
        for (std::size_t k = 0; k < 3; ++k) values[k].push_back(sample.position[k]);
    out.centre = {median(values[0]), median(values[1]), median(values[2])};
    for (const auto& sample : samples) lengths.push_back((Vector3d(sample.position.data()) - out.centre).norm());
    out.scale = median(lengths);
    if (!(out.scale > 0)) throw Error("the positions of most pixels are the same point");
    out.seen.half = {size.width / 2.0, size.height / 2.0};
    Matrix3d spread = Matrix3d::Zero();
    constexpr double far = 10;  // far points would hide how flat the rest is
    for (const auto& sample : samples) {
        const Vector3d p = (Vector3d(sample.position.data()) - out.centre) / out.scale;
        out.seen.points.push_back({p, {2 * sample.x / size.width - 1, 1 - 2 * sample.y / size.height}});
        const Vector3d near = p * std::min(1.0, far / p.norm());
        if (p.norm() > 0) spread += near * near.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread);
    out.axes = solver.eigenvectors().rowwise().reverse();
    if (out.axes.determinant() < 0) out.axes.col(2) = -out.axes.col(2);
    const Vector3d extent = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
    if (!(extent[1] > kFlat * extent[2])) throw Error("the positions of all pixels lie on one line");
    out.flat = !(extent[0] > kFlat * extent[2]);
    return out;
}

/// The camera of clip rows, as one of the points as they were; nothing if it is none.
std::optional<Camera> camera_of(const ClipRows& rows, const Vector3d& centre, double scale) {
    Mat4 clip{};
    for (const auto& [row, from] : {std::pair{0, 0}, {1, 1}, {3, 2}}) {
        for (int k = 0; k < 3; ++k) clip[row][k] = rows(from, k) / scale;
        clip[row][3] = rows(from, 3) - rows.row(from).head<3>().dot(centre) / scale;
    }
    return camera_of_clip(clip);
}

LensCamera lens_of(const Camera& camera) {
    LensCamera lens;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) lens.rotation(i, k) = camera.view[i][k];
        lens.translation[i] = camera.view[i][3];
    }
    lens.focal = camera.proj[1][1];
    lens.fx_by_fy = camera.proj[0][0] / camera.proj[1][1];
    lens.centre = {-camera.proj[0][2], -camera.proj[1][2]};
    lens.skew = camera.proj[1][0];
    return lens;
}

/// The perspective camera with the fewest parameters that explains the points as well as any.
LensFit fit_lens(const Normalised& from, double fx_by_fy) {
    const ClipRows first = from.flat ? fit_plane(from.seen, from.axes, fx_by_fy) : fit_projective(from.seen);
    const auto start = camera_of(first, Vector3d::Zero(), 1);
    if (!start) throw Error("the positions fit no camera");
    LensCamera plain = lens_of(*start);
    plain.fx_by_fy = fx_by_fy, plain.centre.setZero(), plain.skew = 0;
    std::vector<LensFit> fits{refine(from.seen, plain, LensModel::plain)};
    fits.push_back(refine(from.seen, fits.front().camera, LensModel::shifted));
    if (!from.flat) fits.push_back(refine(from.seen, lens_of(*start), LensModel::any));
    const double best = std::ranges::min_element(fits, {}, &LensFit::median)->median;
    return *std::ranges::find_if(
        fits, [&](const LensFit& fit) { return fit.median <= std::max(kClearly * best, best + kWorthIt); });
}

/// A parallel camera's depth is measured from a plane that its pixels do not tell; depths of the samples do.
void place_by_depth(Camera& camera, std::span<const PositionSample> samples) {
    std::vector<double> apart;
    for (const auto& sample : samples) {
        if (std::isnan(sample.depth)) continue;
        const auto& [x, y, z, w] = camera.view[2];
        const auto& p = sample.position;
        apart.push_back(-sample.depth - (x * p[0] + y * p[1] + z * p[2] + w));
    }
    camera.view[2][3] += median(apart);
}

}  // namespace

Camera solve_camera(std::span<const PositionSample> samples, Size size, double pixel_aspect) {
    if (samples.size() < kFewest)
        throw Error(
            fmt::format("only {} of the pixels looked at show a surface; {} are needed", samples.size(), kFewest));
    const Normalised from = normalised(samples, size);
    const double fx_by_fy = size.height / (size.width * pixel_aspect);
    const LensFit lens = fit_lens(from, fx_by_fy);
    if (!from.flat) {
        const ClipRows rows = fit_parallel(from.seen);
        const double off = median(distances(from.seen, rows));
        if (off <= std::max(kClearly * lens.median, lens.median + kWorthIt)) {
            auto camera = camera_of(rows, from.centre, from.scale);
            if (!camera) throw Error("the positions fit no camera");
            place_by_depth(*camera, samples);
            return *camera;
        }
    }
    if (!(lens.focal_doubt < kDoubt))
        throw Error(
            "the positions leave the camera's field of view open: they lie in a plane that faces it, or too few "
            "differ");
    const auto camera = camera_of(lens.camera.rows(), from.centre, from.scale);
    if (!camera) throw Error("the positions fit no camera");
    return *camera;
}

}  // namespace wrinkle::io
