#pragma once

#include <Eigen/Dense>

#include <vector>

/// Fits of cameras to points and their pixels, for solve_camera() only. Points are brought near the origin and to a
/// size near 1 first, or rounding would decide.
namespace wrinkle::io {

struct SeenPoint {
    Eigen::Vector3d point;
    Eigen::Vector2d ndc;  ///< x right, y up, [-1, 1]
};

struct SeenPoints {
    std::vector<SeenPoint> points;
    Eigen::Vector2d half;  ///< half the picture, in pixels
};

/// Rows x, y and w of a projection into clip space.
using ClipRows = Eigen::Matrix<double, 3, 4>;

/// How far from its pixel each point is projected, in pixels; infinite behind the eye.
std::vector<double> distances(const SeenPoints& seen, const ClipRows& clip);

/// The projection of 11 degrees of freedom that fits best, which points of one plane do not determine.
ClipRows fit_projective(const SeenPoints& seen);
/// The parallel projection that fits best.
ClipRows fit_parallel(const SeenPoints& seen);
/// The projection of a plane's points, through the picture's middle and by square pixels but for `fx_by_fy`.
ClipRows fit_plane(const SeenPoints& seen, const Eigen::Matrix3d& axes, double fx_by_fy);

/// A perspective camera in parts, each of which a fit may hold.
struct LensCamera {
    Eigen::Matrix3d rotation;  ///< rows: right, up, back
    Eigen::Vector3d translation;
    double focal = 1, fx_by_fy = 1;  ///< y's factor in clip space, and x's by it
    Eigen::Vector2d centre{0, 0};
    double skew = 0;

    ClipRows rows() const;
};

/// How many parameters a fit has: pose and focal length; the centre too; pixel aspect and skew too.
enum class LensModel { plain = 7, shifted = 9, any = 11 };

/// A camera refined until distances no longer shrink; far ones count little.
struct LensFit {
    LensCamera camera;
    double median = 0;       ///< pixels
    double focal_doubt = 0;  ///< share of the focal length that the distances leave open
};
LensFit refine(const SeenPoints& seen, LensCamera start, LensModel model);

}  // namespace wrinkle::io
