#include "wrinkle/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/vec.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Power of two near 1/x: scaling by it is exact.
double reciprocal_power(double x) { return std::ldexp(1.0, -std::ilogb(x)); }

using Vec4 = std::array<double, 4>;

Vec4 transform(const Mat4& m, const Vec4& v) {
    Vec4 out{};
    for (int i = 0; i < 4; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2] + m[i][3] * v[3];
    return out;
}

[[noreturn]] void refuse_singular() { throw Error("the matrix is singular (it has no inverse)"); }

}  // namespace

Mat4 multiply(const Mat4& a, const Mat4& b) {
    Mat4 out{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) out[i][j] += a[i][k] * b[k][j];
    return out;
}

Mat4 inverse(const Mat4& m) {
    // A world offset of 1e8 or a near plane of 1e-6 makes a regular camera look singular to a pivot threshold, so rows
    // and columns are first scaled to a largest entry near 1: inverse(m) = C inverse(R m C) R.
    Mat4 a = m;
    Vec4 row_scale{1, 1, 1, 1}, column_scale{1, 1, 1, 1};
    const auto scale_for = [](double largest) {
        if (!(largest > 0) || !std::isfinite(largest)) refuse_singular();
        return reciprocal_power(largest);
    };
    for (int j = 0; j < 4; ++j) {
        double largest = 0;
        for (int i = 0; i < 4; ++i) {
            if (!std::isfinite(a[i][j])) throw Error("the matrix holds an entry that is not finite");
            largest = std::max(largest, std::abs(a[i][j]));
        }
        column_scale[j] = scale_for(largest);
        for (int i = 0; i < 4; ++i) a[i][j] *= column_scale[j];
    }
    for (int i = 0; i < 4; ++i) {
        double largest = 0;
        for (double x : a[i]) largest = std::max(largest, std::abs(x));
        row_scale[i] = scale_for(largest);
        for (double& x : a[i]) x *= row_scale[i];
    }

    Mat4 out{};
    for (int i = 0; i < 4; ++i) out[i][i] = 1;
    for (int k = 0; k < 4; ++k) {
        int pivot = k;
        for (int i = k + 1; i < 4; ++i)
            if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
        if (!(std::abs(a[pivot][k]) > 8 * std::numeric_limits<double>::epsilon())) refuse_singular();
        std::swap(a[k], a[pivot]);
        std::swap(out[k], out[pivot]);
        const double diagonal = a[k][k];
        for (int j = 0; j < 4; ++j) {
            a[k][j] /= diagonal;
            out[k][j] /= diagonal;
        }
        for (int i = 0; i < 4; ++i) {
            if (i == k) continue;
            const double factor = a[i][k];
            for (int j = 0; j < 4; ++j) {
                a[i][j] -= factor * a[k][j];
                out[i][j] -= factor * out[k][j];
            }
        }
    }
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            out[i][j] *= column_scale[i] * row_scale[j];
            if (!std::isfinite(out[i][j])) refuse_singular();
        }
    return out;
}

Camera Camera::look_at(Vec3 eye, Vec3 target, Vec3 up, double fov_y, double aspect) {
    if (!(fov_y > 0 && fov_y < std::numbers::pi))
        throw Error("camera: the field of view must be between 0 and 180 degrees");
    if (!(aspect > 0 && std::isfinite(aspect))) throw Error("camera: the aspect must be greater than 0");
    if (eye == target) throw Error("camera: eye and target are the same point");
    if (parallel(subtract(target, eye), up)) throw Error("camera: up is zero or parallel to the viewing direction");
    const Vec3 forward = normalize(subtract(target, eye));
    const Vec3 right = normalize(cross(forward, normalize(up)));
    const Vec3 above = cross(right, forward);

    Camera camera;
    const Vec3 axes[] = {right, above, {-forward[0], -forward[1], -forward[2]}};
    for (int i = 0; i < 3; ++i) camera.view[i] = {axes[i][0], axes[i][1], axes[i][2], -dot(axes[i], eye)};
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
    const auto view_ray = [&](double ndc_x, double ndc_y) {
        return std::array<double, 2>{(p[1][1] * ndc_x - p[0][1] * ndc_y) / det,
                                     (p[0][0] * ndc_y - p[1][0] * ndc_x) / det};
    };
    const auto corner = view_ray(-1 + p[0][2], 1 + p[1][2]);
    const auto step_x = view_ray(2.0 / size.width, 0), step_y = view_ray(0, -2.0 / size.height);

    const Mat4 to_world = inverse(camera.view);
    const auto rotate = [&](double x, double y, double z) {
        Vec3 out{};
        for (int i = 0; i < 3; ++i) out[i] = to_world[i][0] * x + to_world[i][1] * y + to_world[i][2] * z;
        return out;
    };
    return PinholeRays{.eye = {to_world[0][3], to_world[1][3], to_world[2][3]},
                       .d0 = rotate(corner[0], corner[1], -1),
                       .dx = rotate(step_x[0], step_x[1], 0),
                       .dy = rotate(step_y[0], step_y[1], 0)};
}

std::optional<std::array<double, 2>> project(const Camera& camera, Size size, Vec3 point) {
    const Vec4 clip = transform(camera.proj, transform(camera.view, {point[0], point[1], point[2], 1}));
    if (!(clip[3] > 0)) return std::nullopt;
    const double x = (clip[0] / clip[3] + 1) / 2 * size.width, y = (1 - clip[1] / clip[3]) / 2 * size.height;
    if (!std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
    return std::array<double, 2>{x, y};
}

}  // namespace wrinkle
