#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/reference/frame.h"

/// Small cameras and analytic G-buffers for the tests of the references.
namespace wrinkle::reference {

/// At (1, -6, 4), looking at the origin, z up.
inline Mat4 test_view() {
    const Vec<double> eye{1, -6, 4}, back = normalize(eye), right = normalize(cross(Vec<double>{0, 0, 1}, back));
    const Vec<double> up = cross(back, right);
    const auto row = [&](Vec<double> a) { return std::array<double, 4>{a.x, a.y, a.z, -dot(a, eye)}; };
    return {row(right), row(up), row(back), {0, 0, 0, 1}};
}

inline Camera test_camera() {
    return {test_view(), {{{1.8, 0, 0, 0}, {0, 2.4, 0, 0}, {0, 0, -1.002, -0.2002}, {0, 0, -1, 0}}}};
}
/// A pinhole whose axis misses the middle of the frame.
inline Camera shifted_camera() {
    Camera c = test_camera();
    c.proj[0][2] = 0.3;
    c.proj[1][2] = -0.2;
    return c;
}
inline Camera orthographic_camera() {
    return {test_view(), {{{0.25, 0, 0, 0}, {0, 0.3, 0, 0}, {0, 0, -0.02, -1}, {0, 0, 0, 1}}}};
}
/// A camera whose w depends on x: it has an eye, but no planar depth.
inline Camera tilted_camera() {
    Camera c = test_camera();
    c.proj[3] = {0.1, 0, -1, 0.05};
    return c;
}

/// Planes that own their pixels.
struct TestFrame {
    Size size;
    std::map<std::string, std::vector<float>> pixels;

    std::vector<float>& add(const std::string& name, float value = 0) {
        return pixels[name] = std::vector<float>(std::size_t{size.width} * size.height, value);
    }
    Planes planes() const {
        Planes p;
        for (const auto& [name, values] : pixels) p[name] = values;
        return p;
    }
};

/// A frame of the plane through the origin perpendicular to n, with position, normal and depth, and uv = (x, y) / 4
/// along the world's axes.
inline TestFrame plane_frame(const Camera& camera, Size size, Vec<double> n) {
    TestFrame f{size, {}};
    for (const char* name : {"position.x", "position.y", "position.z", "uv.u", "uv.v", "depth"}) f.add(name);
    f.add("normal.x", static_cast<float>(n.x));
    f.add("normal.y", static_cast<float>(n.y));
    f.add("normal.z", static_cast<float>(n.z));
    const CameraRays<double> rays(camera, size);
    for (std::size_t i = 0; i < f.pixels["depth"].size(); ++i) {
        const double x = double(i % size.width) + 0.5, y = double(i / size.width) + 0.5;
        const Vec<double> a = rays.at_depth(x, y, 1), b = rays.at_depth(x, y, 2);
        const double depth = 1 - dot(n, a + rays.eye()) / dot(n, b - a);
        const Vec<double> p = rays.at_depth(x, y, depth) + rays.eye();
        f.pixels["depth"][i] = static_cast<float>(depth);
        f.pixels["position.x"][i] = static_cast<float>(p.x);
        f.pixels["position.y"][i] = static_cast<float>(p.y);
        f.pixels["position.z"][i] = static_cast<float>(p.z);
        f.pixels["uv.u"][i] = static_cast<float>(p.x / 4);
        f.pixels["uv.v"][i] = static_cast<float>(p.y / 4);
    }
    return f;
}

}  // namespace wrinkle::reference
