#include "tools/pixel_points.h"

#include <cmath>

#include "base/imath.h"
#include "io/background.h"
#include "io/camera_placing.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

using Imath::V3d;

/// Neighbours belong to the same surface where their points lie this near to each other's plane, as a share of the
/// step between them, ...
constexpr double kOffPlane = 0.1;
/// ... their normals differ by less than 18 degrees, ...
constexpr double kAligned = 0.95;
/// ... and texture coordinates do not jump, as they do at seams.
constexpr double kSeam = 0.5;

PinholeRays rays_of(const Frame& frame) {
    const auto rays = pinhole_rays(frame.camera, frame.size);
    if (!rays) throw Error("the area of pixels is measured for pinhole cameras only, and this one has no single eye");
    return *rays;
}

}  // namespace

PixelPoints::PixelPoints(const Frame& frame, const Planes& planes)
    : frame_(frame), rays_(rays_of(frame)), planes_(planes) {}

double PixelPoints::value(const std::string& plane, std::uint32_t x, std::uint32_t y) const {
    return planes_.at(plane)[std::size_t{y} * frame_.size.width + x];
}

Vec3 PixelPoints::ray(double x, double y) const {
    return to_array(to_imath(rays_.d0) + x * to_imath(rays_.dx) + y * to_imath(rays_.dy));
}

std::optional<Vec3> PixelPoints::point(std::uint32_t x, std::uint32_t y) const {
    if (has("position.x")) {
        const Vec3 p{value("position.x", x, y), value("position.y", x, y), value("position.z", x, y)};
        const bool finite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
        return finite && p != Vec3{} ? std::optional(p) : std::nullopt;
    }
    const double depth = value("depth", x, y);
    if (!(depth > 0 && depth < kBackgroundDepth)) return std::nullopt;
    const V3d along = to_imath(ray(x + 0.5, y + 0.5));
    return to_array(to_imath(rays_.eye) + depth * (frame_.ray_depth ? direction(along) : along));
}

std::optional<Vec3> PixelPoints::normal(std::uint32_t x, std::uint32_t y) const {
    const auto p = point(x, y);
    const V3d n = direction({value("normal.x", x, y), value("normal.y", x, y), value("normal.z", x, y)});
    if (!p || !(n.length() > 0.5)) return std::nullopt;
    return to_array(n.dot(to_imath(rays_.eye) - to_imath(*p)) < 0 ? -n : n);
}

std::optional<PixelPoints::Chart> PixelPoints::chart(std::uint32_t x, std::uint32_t y) const {
    const V3d p = to_imath(point(x, y).value()), n = to_imath(normal(x, y).value());
    Chart chart;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        int continued = 0;
        V3d step(0);
        double u = 0, v = 0;
        for (const int sign : {-1, 1}) {
            const std::int64_t at_x = std::int64_t{x} + (axis == 0 ? sign : 0),
                               at_y = std::int64_t{y} + (axis == 1 ? sign : 0);
            if (at_x < 0 || at_y < 0 || at_x >= frame_.size.width || at_y >= frame_.size.height) continue;
            const auto nx = static_cast<std::uint32_t>(at_x), ny = static_cast<std::uint32_t>(at_y);
            const auto other = point(nx, ny), facing = normal(nx, ny);
            if (!other || !facing) continue;
            const V3d to = to_imath(*other) - p;
            const double du = value("uv.u", nx, ny) - value("uv.u", x, y),
                         dv = value("uv.v", nx, ny) - value("uv.v", x, y);
            if (!(std::abs(to.dot(n)) < kOffPlane * to.length()) || !(to_imath(*facing).dot(n) > kAligned) ||
                !(std::abs(du) < kSeam) || !(std::abs(dv) < kSeam) ||
                (has("object") && value("object", nx, ny) != value("object", x, y)))
                continue;
            step += static_cast<double>(sign) * to, u += sign * du, v += sign * dv;
            ++continued;
        }
        if (continued == 0) return std::nullopt;
        const double share = 1.0 / continued;
        chart.along[axis] = to_array(share * (step - n * step.dot(n)));
        chart.uv[axis] = {share * u, share * v};
    }
    return chart;
}

Camera PixelPoints::camera(std::uint32_t x, std::uint32_t y) const {
    const FrameWindow window{static_cast<int>(x * kPointsAlong),
                             static_cast<int>(y * kPointsAlong),
                             {frame_.size.width * kPointsAlong, frame_.size.height * kPointsAlong}};
    return io::windowed(frame_.camera, window, {kPointsAlong, kPointsAlong});
}

bool PixelPoints::write(std::uint32_t x, std::uint32_t y, const std::map<std::string, float*>& out) const {
    const auto centre = point(x, y), facing = normal(x, y);
    if (!centre || !facing) return false;
    std::optional<Chart> uv;
    if (out.contains("uv.u") && !(uv = chart(x, y))) return false;
    for (const auto& [plane, points] : out) {
        const double scale = plane.starts_with("duv_d") ? 1.0 / kPointsAlong : 1;  // they are per pixel
        std::fill_n(points, kPointsOfPixel, static_cast<float>(scale * value(plane, x, y)));
    }
    const V3d p = to_imath(*centre), n = to_imath(*facing), eye = to_imath(rays_.eye);
    const auto put = [&](const char* plane, std::size_t i, double number) {
        if (const auto found = out.find(plane); found != out.end()) found->second[i] = static_cast<float>(number);
    };
    for (std::size_t i = 0; i < kPointsOfPixel; ++i) {
        const V3d d = to_imath(ray(x + (static_cast<double>(i % kPointsAlong) + 0.5) / kPointsAlong,
                                   y + (static_cast<double>(i / kPointsAlong) + 0.5) / kPointsAlong));
        const double depth = (p - eye).dot(n) / d.dot(n);
        if (!(depth > 0) || !std::isfinite(depth)) return false;
        const V3d at = eye + depth * d;
        put("depth", i, frame_.ray_depth ? depth * d.length() : depth);
        put("position.x", i, at.x), put("position.y", i, at.y), put("position.z", i, at.z);
        if (!uv) continue;
        // at - p = a along[0] + b along[1]
        const V3d e = to_imath(uv->along[0]), f = to_imath(uv->along[1]), across = e.cross(f);
        const double area = across.length2();
        if (!(area > 0)) return false;
        const double a = (at - p).cross(f).dot(across) / area, b = e.cross(at - p).dot(across) / area;
        put("uv.u", i, value("uv.u", x, y) + a * uv->uv[0][0] + b * uv->uv[1][0]);
        put("uv.v", i, value("uv.v", x, y) + a * uv->uv[0][1] + b * uv->uv[1][1]);
    }
    return true;
}

}  // namespace wrinkle
