#include "io/header_camera.h"

#include <cmath>

namespace wrinkle::io {
namespace {

using Row = std::array<double, 4>;

double dot3(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// a - k b, all four components.
Row subtract(Row a, double k, const Row& b) {
    for (std::size_t i = 0; i < 4; ++i) a[i] -= k * b[i];
    return a;
}

Row divide(Row a, double k) {
    for (double& value : a) value /= k;
    return a;
}

bool usable(double scale) { return std::isnormal(scale) && scale > 0; }

}  // namespace

std::optional<Camera> camera_of_clip(const Mat4& clip) {
    constexpr double near_plane = 0.01;      // any would do, since clip depth is never used
    constexpr double parallel_share = 1e-9;  // w varies by less than this share of its constant: a parallel projection
    Row x = clip[0], y = clip[1], w = clip[3];
    const double slope = std::sqrt(dot3(w, w));
    const bool perspective = slope > parallel_share * std::abs(w[3]);
    const double scale = perspective ? slope : w[3];
    if (!usable(scale)) return std::nullopt;
    x = divide(x, scale), y = divide(y, scale), w = divide(w, scale);

    // The row x is fx times the axis to the right plus cx times the forward axis. The axes are perpendicular unit
    // vectors, so projections onto them give the factors, one after the other. The fourth components are treated alike.
    const double cx = perspective ? dot3(x, w) : 0, cy = perspective ? dot3(y, w) : 0;
    if (perspective) x = subtract(x, cx, w), y = subtract(y, cy, w);
    const double fx = std::sqrt(dot3(x, x));
    if (!usable(fx)) return std::nullopt;
    const Row right = divide(x, fx);
    const double skew = dot3(y, right);
    y = subtract(y, skew, right);
    const double fy = std::sqrt(dot3(y, y));
    if (!usable(fy)) return std::nullopt;
    const Row up = divide(y, fy);

    Camera camera;
    const Row back = perspective ? divide(w, -1)
                                 : Row{right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
                                       right[0] * up[1] - right[1] * up[0], 0};
    camera.view = {{right, up, back, {0, 0, 0, 1}}};
    if (perspective) {
        camera.proj = {{{fx, 0, -cx, 0}, {skew, fy, -cy, 0}, {0, 0, -1, -2 * near_plane}, {0, 0, -1, 0}}};
    } else {
        camera.proj = {{{fx, 0, 0, 0}, {skew, fy, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}}};
    }
    return camera;
}

}  // namespace wrinkle::io
