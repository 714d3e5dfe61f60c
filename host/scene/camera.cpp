#include "wrinkle/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/imath.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

using Vec4 = std::array<double, 4>;

[[noreturn]] void refuse_singular() { throw Error("the matrix is singular (it has no inverse)"); }

/// A power of two, by which scaling is exact, that brings `largest` near 1.
double scale_for(double largest) {
    if (!(largest > 0) || !std::isfinite(largest)) refuse_singular();
    return std::ldexp(1.0, -std::ilogb(largest));
}

/// Of a matrix whose rows and columns are near 1 in size, so that a regular one has an inverse of moderate entries.
Imath::M44d inverse_of_scaled(const Imath::M44d& m) {
    constexpr double kMost = 1 / (8 * std::numeric_limits<double>::epsilon());
    Imath::M44d out;
    try {
        out = m.gjInverse(true);
    } catch (const std::invalid_argument&) { refuse_singular(); }
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            if (!(std::abs(out[i][j]) < kMost)) refuse_singular();
    return out;
}

}  // namespace

Mat4 multiply(const Mat4& a, const Mat4& b) { return to_array(to_imath(b) * to_imath(a)); }

Mat4 inverse(const Mat4& m) {
    // A world offset of 1e8 or a near plane of 1e-6 makes a regular camera look singular to any threshold, so rows and
    // columns are first scaled to a largest entry near 1: inverse(m) = C inverse(R m C) R.
    Vec4 row_scale{}, column_scale{};
    for (int j = 0; j < 4; ++j) {
        double largest = 0;
        for (int i = 0; i < 4; ++i) {
            if (!std::isfinite(m[i][j])) throw Error("the matrix holds an entry that is not finite");
            largest = std::max(largest, std::abs(m[i][j]));
        }
        column_scale[j] = scale_for(largest);
    }
    Imath::M44d scaled;
    for (int i = 0; i < 4; ++i) {
        double largest = 0;
        for (int j = 0; j < 4; ++j) largest = std::max(largest, std::abs(m[i][j] * column_scale[j]));
        row_scale[i] = scale_for(largest);
        for (int j = 0; j < 4; ++j) scaled[i][j] = m[i][j] * column_scale[j] * row_scale[i];
    }
    const Imath::M44d inverted = inverse_of_scaled(scaled);
    Mat4 out{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            out[i][j] = inverted[i][j] * column_scale[i] * row_scale[j];
            if (!std::isfinite(out[i][j])) refuse_singular();
        }
    return out;
}

Camera Camera::look_at(Vec3 eye, Vec3 target, Vec3 up, double fov_y, double aspect) {
    if (!(fov_y > 0 && fov_y < std::numbers::pi))
        throw Error("camera: the field of view must be between 0 and 180 degrees");
    if (!(aspect > 0 && std::isfinite(aspect))) throw Error("camera: the aspect must be greater than 0");
    if (eye == target) throw Error("camera: eye and target are the same point");
    const Imath::V3d from = to_imath(eye), along = to_imath(target) - from;
    if (parallel(along, to_imath(up))) throw Error("camera: up is zero or parallel to the viewing direction");
    const Imath::V3d forward = direction(along), right = direction(forward.cross(direction(to_imath(up))));
    const Imath::V3d axes[] = {right, right.cross(forward), -forward};

    Camera camera;
    for (int i = 0; i < 3; ++i) camera.view[i] = {axes[i].x, axes[i].y, axes[i].z, -axes[i].dot(from)};
    camera.view[3] = {0, 0, 0, 1};

    // Clip planes matter to nobody here; an infinite far plane spares the choice of one and keeps proj regular.
    constexpr double near_plane = 0.01;
    const double focal = 1 / std::tan(fov_y / 2);
    camera.proj = {{{focal / aspect, 0, 0, 0}, {0, focal, 0, 0}, {0, 0, -1, -2 * near_plane}, {0, 0, -1, 0}}};
    return camera;
}

std::optional<PinholeRays> pinhole_rays(const Camera& camera, Size size) {
    const Mat4& p = camera.proj;
    if (size.width == 0 || size.height == 0) return std::nullopt;
    if (p[3] != Vec4{0, 0, -1, 0} || p[0][3] != 0 || p[1][3] != 0) return std::nullopt;
    if (camera.view[3] != Vec4{0, 0, 0, 1}) return std::nullopt;

    // A view ray (X, Y, -1) has w = 1, so NDC = P (X, Y) - (p02, p12) with the upper left 2x2 block P.
    const double det = p[0][0] * p[1][1] - p[0][1] * p[1][0];
    if (!std::isnormal(det)) return std::nullopt;
    const Imath::M44d to_world = to_imath(inverse(camera.view));
    const auto world_ray = [&](double ndc_x, double ndc_y, double z) {
        Imath::V3d ray;
        to_world.multDirMatrix(
            Imath::V3d((p[1][1] * ndc_x - p[0][1] * ndc_y) / det, (p[0][0] * ndc_y - p[1][0] * ndc_x) / det, z), ray);
        return to_array(ray);
    };
    return PinholeRays{.eye = to_array(to_world.translation()),
                       .d0 = world_ray(-1 + p[0][2], 1 + p[1][2], -1),
                       .dx = world_ray(2.0 / size.width, 0, 0),
                       .dy = world_ray(0, -2.0 / size.height, 0)};
}

std::optional<std::array<double, 2>> project(const Camera& camera, Size size, Vec3 point) {
    const Imath::V4d clip = Imath::V4d(point[0], point[1], point[2], 1) * to_imath(camera.view) * to_imath(camera.proj);
    if (!(clip.w > 0)) return std::nullopt;
    const double x = (clip.x / clip.w + 1) / 2 * size.width, y = (1 - clip.y / clip.w) / 2 * size.height;
    if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    return std::array<double, 2>{x, y};
}

}  // namespace wrinkle
