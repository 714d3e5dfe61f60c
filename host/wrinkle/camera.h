#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace [[gnu::visibility("default")]] wrinkle {

using Vec3 = std::array<double, 3>;
using Mat4 = std::array<std::array<double, 4>, 4>;  ///< rows; acts on column vectors

struct Size {
    std::uint32_t width = 0, height = 0;
    friend bool operator==(Size, Size) = default;
};

/// A camera in world space: clip = proj * view * p, camera looks down -z of view space (OpenGL), y up.
/// Pixel (x, y) covers NDC x = 2x/width - 1, y = 1 - 2y/height; pixel centres lie at .5.
///
///     const auto camera = wrinkle::Camera::look_at({0, -5, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 16.0 / 9);
///     const auto pixel = wrinkle::project(camera, {1920, 1080}, {0, 0, 0});  // the middle: 960, 540
///
/// Threads: a value, used as any other; the functions below keep nothing between calls.
struct Camera {
    Mat4 view{};  ///< world to camera, rigid
    Mat4 proj{};  ///< camera to clip; perspective, orthographic or oblique

    /// Camera at `eye` looking at `target`. `fov_y` in radians, vertical.
    static Camera look_at(Vec3 eye, Vec3 target, Vec3 up, double fov_y, double aspect);
};

Mat4 multiply(const Mat4& a, const Mat4& b);
Mat4 inverse(const Mat4& m);  ///< Throws Error when m is singular.

/// Rays of a pinhole camera, world space, through pixel (x, y): d(x, y) = d0 + x dx + y dy, scaled so that the view
/// depth of d is 1: the point with planar depth z is eye + z d.
struct PinholeRays {
    Vec3 eye, d0, dx, dy;
};

/// The rays of `camera`, or nothing where no single eye point with planar depth exists (orthographic, a w that is not
/// the view depth, degenerate): then the general 4x4 form of the screen derivatives is used. An oblique near plane
/// changes nothing here: it bends depth in clip space, not the rays.
std::optional<PinholeRays> pinhole_rays(const Camera& camera, Size size);

/// World point to pixel coordinates (x right, y down); nothing for points at or behind the eye.
std::optional<std::array<double, 2>> project(const Camera& camera, Size size, Vec3 point);

}  // namespace wrinkle
