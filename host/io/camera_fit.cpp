#include "io/camera_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/median.h"

namespace wrinkle::io {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector4d, Eigen::VectorXd;

constexpr double kSmallest = 1e-5;  // pixels: less than what floats round to

/// Weights that leave out what is far off: one at 0, a half at 1.5 medians.
std::vector<double> weights_of(const std::vector<double>& off) {
    const double scale = std::max(1.5 * median(off), kSmallest);
    std::vector<double> weights;
    for (const double distance : off) weights.push_back(1 / (1 + distance * distance / (scale * scale)));
    return weights;
}

Eigen::MatrixXd smallest_eigenvector(const Eigen::MatrixXd& m) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvectors().col(0);
}

/// Points lie in front of the eye, not behind it.
void turn_to_front(const SeenPoints& seen, ClipRows& clip) {
    std::ptrdiff_t front = 0;
    for (const auto& [p, ndc] : seen.points) front += clip.row(2).dot(p.homogeneous()) > 0 ? 1 : -1;
    if (front < 0) clip = -clip;
}

/// The direct linear transform, whose equations are divided by w and weighted over and over, so that what it minimises
/// becomes distances in pixels. Points are functions' values: all four coordinates, or those within a plane.
template <int N, class Coordinates>
Eigen::Matrix<double, 3, N> direct_fit(const SeenPoints& seen, const Coordinates& coordinates) {
    constexpr int rounds = 12;
    using Rows = Eigen::Matrix<double, 3, N>;
    std::vector<double> weights(seen.points.size(), 1.0), w(seen.points.size(), 1.0);
    Rows rows;
    for (int round = 0; round < rounds; ++round) {
        Eigen::Matrix<double, 3 * N, 3 * N> sum = Eigen::Matrix<double, 3 * N, 3 * N>::Zero();
        for (std::size_t i = 0; i < seen.points.size(); ++i) {
            const Eigen::Matrix<double, N, 1> q = coordinates(seen.points[i].point);
            for (int axis = 0; axis < 2; ++axis) {
                Eigen::Matrix<double, 3 * N, 1> equation = Eigen::Matrix<double, 3 * N, 1>::Zero();
                equation.template segment<N>(axis * N) = q;
                equation.template segment<N>(2 * N) = -seen.points[i].ndc[axis] * q;
                equation *= seen.half[axis] / w[i];
                sum.template selfadjointView<Eigen::Lower>().rankUpdate(equation, weights[i]);
            }
        }
        const Eigen::MatrixXd v = smallest_eigenvector(Eigen::MatrixXd(sum.template selfadjointView<Eigen::Lower>()));
        for (int r = 0; r < 3; ++r) rows.row(r) = v.block(r * N, 0, N, 1).transpose();
        std::vector<double> off(seen.points.size()), size(seen.points.size());
        for (std::size_t i = 0; i < off.size(); ++i) {
            const Vector3d clip = rows * coordinates(seen.points[i].point);
            off[i] = ((clip.head<2>() / clip.z() - seen.points[i].ndc).cwiseProduct(seen.half)).norm();
            if (!std::isfinite(off[i])) off[i] = std::numeric_limits<double>::max();
            size[i] = std::abs(clip.z());
        }
        const double usual = std::max(median(size), std::numeric_limits<double>::min());
        for (std::size_t i = 0; i < off.size(); ++i) w[i] = std::max(size[i] / usual, 1e-3);
        weights = weights_of(off);
    }
    return rows;
}

VectorXd parameters_of(LensModel model) { return VectorXd::Zero(static_cast<int>(model)); }

/// A camera that is moved by small parameters.
LensCamera moved(LensCamera camera, const VectorXd& by) {
    const Vector3d turn = by.head<3>();
    if (const double angle = turn.norm(); angle > 0)
        camera.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * camera.rotation;
    camera.translation += by.segment<3>(3);
    camera.focal *= std::exp(by[6]);
    if (by.size() > 7) camera.centre += by.segment<2>(7);
    if (by.size() > 9) camera.fx_by_fy *= std::exp(by[9]), camera.skew += by[10];
    return camera;
}

/// Pixels that each point is off, x and y; points behind the eye are as far off as the picture is wide.
VectorXd offsets(const SeenPoints& seen, const LensCamera& camera) {
    const ClipRows rows = camera.rows();
    VectorXd off(2 * static_cast<Eigen::Index>(seen.points.size()));
    for (std::size_t i = 0; i < seen.points.size(); ++i) {
        const Vector3d clip = rows * seen.points[i].point.homogeneous();
        const auto at = 2 * static_cast<Eigen::Index>(i);
        if (clip.z() > 0)
            off.segment<2>(at) = (clip.head<2>() / clip.z() - seen.points[i].ndc).cwiseProduct(seen.half);
        else
            off.segment<2>(at) = 2 * seen.half;
    }
    return off;
}

}  // namespace

std::vector<double> distances(const SeenPoints& seen, const ClipRows& clip) {
    std::vector<double> off;
    for (const auto& [p, ndc] : seen.points) {
        const Vector3d at = clip * p.homogeneous();
        const double distance = ((at.head<2>() / at.z() - ndc).cwiseProduct(seen.half)).norm();
        off.push_back(at.z() > 0 && std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity());
    }
    return off;
}

ClipRows fit_projective(const SeenPoints& seen) {
    ClipRows rows = direct_fit<4>(seen, [](const Vector3d& p) -> Vector4d { return p.homogeneous(); });
    turn_to_front(seen, rows);
    return rows;
}

ClipRows fit_parallel(const SeenPoints& seen) {
    constexpr int rounds = 8;
    std::vector<double> weights(seen.points.size(), 1.0);
    ClipRows rows = ClipRows::Zero();
    rows(2, 3) = 1;
    for (int round = 0; round < rounds; ++round) {
        Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
        Eigen::Matrix<double, 4, 2> right = Eigen::Matrix<double, 4, 2>::Zero();
        for (std::size_t i = 0; i < seen.points.size(); ++i) {
            const Vector4d q = seen.points[i].point.homogeneous();
            sum += weights[i] * q * q.transpose();
            right += weights[i] * q * seen.points[i].ndc.transpose();
        }
        rows.topRows<2>() = sum.ldlt().solve(right).transpose();
        weights = weights_of(distances(seen, rows));
    }
    return rows;
}

ClipRows fit_plane(const SeenPoints& seen, const Matrix3d& axes, double fx_by_fy) {
    const Matrix3d homography =
        direct_fit<3>(seen, [&](const Vector3d& p) { return Vector3d(axes.col(0).dot(p), axes.col(1).dot(p), 1); });
    std::vector<double> heights;
    for (const auto& at : seen.points) heights.push_back(axes.col(2).dot(at.point));
    const double height = median(heights);
    ClipRows best = ClipRows::Zero();
    double least = std::numeric_limits<double>::infinity();
    for (double fov = 5; fov < 150; fov *= 1.3)  // the one that is nearest will be refined
        for (const double side : {1.0, -1.0}) {
            LensCamera camera;
            camera.focal = 1 / std::tan(fov / 2 * EIGEN_PI / 180);
            camera.fx_by_fy = fx_by_fy;
            const Vector3d unscale(1 / (camera.focal * fx_by_fy), 1 / camera.focal, -1);
            Matrix3d columns = side * unscale.asDiagonal() * homography;  // images of the axes, and of the origin
            columns /= std::sqrt(columns.col(0).norm() * columns.col(1).norm());
            Matrix3d image;
            image << columns.col(0), columns.col(1), columns.col(0).cross(columns.col(1));
            const Eigen::JacobiSVD<Matrix3d> svd(image, Eigen::ComputeFullU | Eigen::ComputeFullV);
            camera.rotation = svd.matrixU() * svd.matrixV().transpose() * axes.transpose();
            camera.translation = columns.col(2) - height * camera.rotation * axes.col(2);
            const ClipRows rows = camera.rows();
            if (const double off = median(distances(seen, rows)); off < least) least = off, best = rows;
        }
    return best;
}

ClipRows LensCamera::rows() const {
    ClipRows view;
    view << rotation, translation;
    ClipRows clip;
    clip.row(2) = -view.row(2);
    clip.row(0) = focal * fx_by_fy * view.row(0) + centre.x() * clip.row(2);
    clip.row(1) = focal * view.row(1) + skew * view.row(0) + centre.y() * clip.row(2);
    return clip;
}

LensFit refine(const SeenPoints& seen, LensCamera start, LensModel model) {
    constexpr int most = 40;
    constexpr double step = 1e-6, enough = 1e-9;
    const int parameters = static_cast<int>(model);
    double damping = 1e-3;
    Eigen::MatrixXd normal;
    for (int round = 0; round < most; ++round) {
        const VectorXd off = offsets(seen, start);
        const auto weights = weights_of(distances(seen, start.rows()));
        Eigen::MatrixXd slopes(off.size(), parameters);
        for (int k = 0; k < parameters; ++k) {
            VectorXd by = parameters_of(model);
            by[k] = step;
            slopes.col(k) = (offsets(seen, moved(start, by)) - off) / step;
        }
        VectorXd weight(off.size());
        for (Eigen::Index i = 0; i < off.size(); ++i) weight[i] = weights[static_cast<std::size_t>(i / 2)];
        normal = slopes.transpose() * weight.asDiagonal() * slopes;
        const VectorXd right = -slopes.transpose() * weight.asDiagonal() * off;
        const auto cost = [&](const LensCamera& camera) {
            return offsets(seen, camera).cwiseAbs2().cwiseProduct(weight).sum();
        };
        const double before = cost(start);
        bool better = false;
        double moved_by = 0;
        for (int tries = 0; tries < 8 && !better; ++tries, damping *= 10) {
            Eigen::MatrixXd damped = normal;
            damped.diagonal() *= 1 + damping;
            const VectorXd by = damped.ldlt().solve(right);
            const LensCamera next = moved(start, by);
            if (!by.allFinite() || !(cost(next) <= before)) continue;
            start = next, better = true, moved_by = by.norm();
            damping /= 100;
        }
        if (!better || moved_by < enough) break;
    }
    constexpr double least_noise = 0.002;  // pixels: what positions of floats are usually off
    const double median_off = median(distances(seen, start.rows()));
    const double noise = std::max(median_off, least_noise);
    const Eigen::MatrixXd spread = normal.ldlt().solve(Eigen::MatrixXd::Identity(parameters, parameters));
    const double doubt = spread.allFinite() && spread(6, 6) > 0 ? noise * std::sqrt(spread(6, 6))
                                                                : std::numeric_limits<double>::infinity();
    return {start, median_off, doubt};
}

}  // namespace wrinkle::io
