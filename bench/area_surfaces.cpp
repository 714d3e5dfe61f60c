#include "area_surfaces.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "texture_system.h"

namespace wrinkle::bench {

namespace {

constexpr double kFar = 2000;  // metres

using Hit = AreaSurface::Hit;

Vec3 along(const Vec3& eye, const Vec3& ray, double depth) {
    return {eye[0] + depth * ray[0], eye[1] + depth * ray[1], eye[2] + depth * ray[2]};
}

std::optional<Hit> ground(const Vec3& eye, const Vec3& ray) {
    const double depth = -eye[2] / ray[2];
    if (!(depth > 0 && depth < kFar)) return {};
    const Vec3 p = along(eye, ray, depth);
    return Hit{depth, {0, 0, 1}, p[0] / kGroundRepeat, p[1] / kGroundRepeat};
}

/// The plane x = 0, seen from its right.
std::optional<Hit> wall(const Vec3& eye, const Vec3& ray) {
    const double depth = -eye[0] / ray[0];
    if (!(depth > 0 && depth < kFar)) return {};
    const Vec3 p = along(eye, ray, depth);
    return Hit{depth, {1, 0, 0}, p[1] / kGroundRepeat, p[2] / kGroundRepeat};
}

/// Around the origin, of radius 1; its seam lies behind.
std::optional<Hit> ball(const Vec3& eye, const Vec3& ray) {
    const double a = dot(ray, ray), b = dot(ray, eye), c = dot(eye, eye) - 1, root = b * b - a * c;
    if (root <= 0) return {};
    const double depth = (-b - std::sqrt(root)) / a;
    const Vec3 n = normalize(along(eye, ray, depth));
    return Hit{depth, n, std::atan2(n[0], -n[1]) / kGroundRepeat,
               std::asin(std::clamp(n[2], -1.0, 1.0)) / kGroundRepeat};
}

}  // namespace

BenchFrame AreaSurface::frame(std::uint32_t factor) const {
    const Size whole{size.width * factor, size.height * factor};
    return window(whole, 0, whole);
}

BenchFrame AreaSurface::column(std::uint32_t x, std::uint32_t points) const {
    return window({size.width * points, size.height * points}, x * points, {points, size.height * points});
}

/// Columns from `left` on of a frame of `whole`; their camera sees the window alone.
BenchFrame AreaSurface::window(Size whole, std::uint32_t left, Size window) const {
    const double wide = static_cast<double>(whole.width) / window.width;
    Camera camera = camera_;
    for (std::size_t k = 0; k < 4; ++k)  // NDC of the window: x' = wide (x + 1) - 1 - 2 left / width
        camera.proj[0][k] = wide * camera_.proj[0][k] + (wide - 1 - 2.0 * left / window.width) * camera_.proj[3][k];
    BenchFrame out;
    out.frame.size = window;
    out.frame.camera = camera;
    for (const char* name : {"depth", "normal.x", "normal.y", "normal.z", "uv.u", "uv.v"}) {
        out.frame.planes.insert(name);
        out.planes[name].resize(out.pixels());
    }
    const PinholeRays rays = pinhole_rays(camera, window).value();
    for (std::size_t i = 0; i < out.pixels(); ++i) {
        const double x = static_cast<double>(i % window.width) + 0.5, y = static_cast<double>(i / window.width) + 0.5;
        Vec3 ray{};
        for (std::size_t k = 0; k < 3; ++k) ray[k] = rays.d0[k] + x * rays.dx[k] + y * rays.dy[k];
        const std::optional<Hit> hit = first_hit_(rays.eye, ray);
        out.planes["depth"][i] = hit ? static_cast<float>(hit->depth) : 1e10f;
        const Vec3 normal = hit ? hit->normal : Vec3{0, 0, 1};
        for (std::size_t k = 0; k < 3; ++k)
            out.planes[std::string("normal.") + "xyz"[k]][i] = static_cast<float>(normal[k]);
        out.planes["uv.u"][i] = hit ? static_cast<float>(hit->u) : 0;
        out.planes["uv.v"][i] = hit ? static_cast<float>(hit->v) : 0;
    }
    return out;
}

std::vector<AreaSurface> area_surfaces() {
    const auto seen = [](Size size, Vec3 eye, Vec3 target, double fov_y) {
        return Camera::look_at(eye, target, {0, 0, 1}, fov_y, static_cast<double>(size.width) / size.height);
    };
    constexpr Size large{480, 270}, small{240, 100};
    std::vector<AreaSurface> all{{"ground", large, seen(large, {0, -6, 1.6}, {0, 0, 0.6}, 0.6981317007977318), ground},
                                 {"wall", small, seen(small, {1.2, -6, 0.4}, {0, 0, 0.3}, 0.6), wall},
                                 {"ball", small, seen(small, {0, -5, 0.3}, {0, 0, 0}, 0.42), ball}};
    all[1].decal_x = {0, 1, 0}, all[1].decal_y = {0, 0, 1}, all[1].decal_center = {0, -4, 0};
    all[2].decal_x = {1, 0, 0}, all[2].decal_y = {0, 0, 1}, all[2].decal_center = {0, -1, 0};
    all[2].volume_side = 2.4, all[2].volume_middle = 0.5;
    return all;
}

}  // namespace wrinkle::bench
