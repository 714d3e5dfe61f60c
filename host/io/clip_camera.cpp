#include <ImathVec.h>

#include <cmath>

#include "io/header_camera.h"

namespace wrinkle::io {
namespace {

using Imath::V3d, Imath::V4d;

V3d xyz(const V4d& row) { return {row.x, row.y, row.z}; }

bool usable(double scale) { return std::isnormal(scale) && scale > 0; }

}  // namespace

std::optional<Camera> camera_of_clip(const Mat4& clip) {
    constexpr double near_plane = 0.01;      // any would do, since clip depth is never used
    constexpr double parallel_share = 1e-9;  // w varies by less than this share of its constant: a parallel projection
    const auto row = [&](std::size_t i) { return V4d(clip[i][0], clip[i][1], clip[i][2], clip[i][3]); };
    V4d x = row(0), y = row(1), w = row(3);
    const double slope = xyz(w).length();
    const bool perspective = slope > parallel_share * std::abs(w.w);
    const double scale = perspective ? slope : w.w;
    if (!usable(scale)) return std::nullopt;
    x /= scale, y /= scale, w /= scale;

    // The row x is fx times the axis to the right plus cx times the forward axis. The axes are perpendicular unit
    // vectors, so projections onto them give the factors, one after the other. The fourth components are treated alike.
    const double cx = perspective ? xyz(x).dot(xyz(w)) : 0, cy = perspective ? xyz(y).dot(xyz(w)) : 0;
    if (perspective) x -= cx * w, y -= cy * w;
    const double fx = xyz(x).length();
    if (!usable(fx)) return std::nullopt;
    const V4d right = x / fx;
    const double skew = xyz(y).dot(xyz(right));
    y -= skew * right;
    const double fy = xyz(y).length();
    if (!usable(fy)) return std::nullopt;
    const V4d up = y / fy;

    Camera camera;
    V4d back = -w;
    if (!perspective) {
        const V3d axis = xyz(right).cross(xyz(up));
        back = {axis.x, axis.y, axis.z, 0};
    }
    camera.view = {{{right.x, right.y, right.z, right.w},
                    {up.x, up.y, up.z, up.w},
                    {back.x, back.y, back.z, back.w},
                    {0, 0, 0, 1}}};
    if (perspective) {
        camera.proj = {{{fx, 0, -cx, 0}, {skew, fy, -cy, 0}, {0, 0, -1, -2 * near_plane}, {0, 0, -1, 0}}};
    } else {
        camera.proj = {{{fx, 0, 0, 0}, {skew, fy, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}}};
    }
    return camera;
}

}  // namespace wrinkle::io
