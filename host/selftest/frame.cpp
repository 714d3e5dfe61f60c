#include <cmath>
#include <optional>

#include "base/vec.h"
#include "selftest/scenes.h"

namespace wrinkle::selftest {

namespace {

constexpr Vec3 kCenter{0, 0, 0.6};
constexpr double kRadius = 0.8;

/// The distance at which a ray from `from` meets the ball, if it does.
std::optional<double> to_ball(const Vec3& from, const Vec3& ray) {
    const Vec3 away = subtract(from, kCenter);
    const double a = dot(ray, ray), b = dot(ray, away), c = dot(away, away) - kRadius * kRadius;
    const double root = b * b - a * c;
    return root < 0 ? std::nullopt : std::optional((-b - std::sqrt(root)) / a);
}

/// Numbers that every compiler arrives at, whatever it contracts: to 12 bits behind the point.
float rounded(double value) { return static_cast<float>(std::round(value * 4096) / 4096); }

}  // namespace

CheckedFrame checked_frame() {
    const Size size{19, 13};
    CheckedFrame out;
    out.frame.size = size;
    out.frame.camera = Camera::look_at({0.5, -4, 2.5}, {0, 0, 0.2}, {0, 0, 1}, 0.4, 19.0 / 13);
    const PinholeRays rays = pinhole_rays(out.frame.camera, size).value();
    const auto put = [&](const std::string& plane, double value) { out.planes[plane].push_back(rounded(value)); };
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            Vec3 ray;
            for (std::size_t k = 0; k < 3; ++k) ray[k] = rays.d0[k] + (x + 0.5) * rays.dx[k] + (y + 0.5) * rays.dy[k];
            const std::optional<double> ball = to_ball(rays.eye, ray);
            const double depth = ball.value_or(-rays.eye[2] / ray[2]);
            Vec3 p, n{0, 0, 1};
            for (std::size_t k = 0; k < 3; ++k) p[k] = rays.eye[k] + depth * ray[k];
            if (ball) n = normalize(subtract(p, kCenter));
            put("depth", depth);
            put("normal.x", n[0]), put("normal.y", n[1]), put("normal.z", n[2]);
            put("uv.u", p[0] / 2), put("uv.v", (ball ? p[2] : p[1]) / 2);
            put("object", ball ? 2 : 1);
        }
    for (const auto& [name, values] : out.planes) out.frame.planes.insert(name);
    return out;
}

}  // namespace wrinkle::selftest
