// How exact derivatives of texture coordinates are when they have to be found from neighbours, on a surface that curves
// away: a ball, on which longitude and latitude have derivatives in closed form.
#include <numbers>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using reference::CameraRays;

constexpr double radius = 1.5;

/// A ball 5 metres before the camera, its pole towards the eye: depth, normals, longitude as u and latitude as v. With
/// `derivatives`, also the planes of their derivatives.
HostFrame ball_frame(const Camera& camera, Size size, bool derivatives) {
    HostFrame frame;
    frame.frame.size = size, frame.frame.camera = camera;
    const auto put = [&](const std::string& name, std::size_t i, double value) {
        if (!frame.pixels.contains(name)) frame.add(name);
        frame.pixels.at(name)[i] = static_cast<float>(value);
    };
    const CameraRays<double> rays(camera, size);
    const V center = rays.at_depth(size.width / 2.0, size.height / 2.0, 5), pole = normalize(center * -1.0);
    const V side = normalize(cross(pole, V{0.3, 1, 0.2})), up = cross(pole, side);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const double x = double(i % size.width) + 0.5, y = double(i / size.width) + 0.5;
        const V ray = rays.at_depth(x, y, 1);
        const double middle = dot(ray, center) / dot(ray, ray);
        const double square = middle * middle - (dot(center, center) - radius * radius) / dot(ray, ray);
        const double depth = square > 0 ? middle - std::sqrt(square) : 1e10;
        const V p = ray * depth, n = normalize(p - center);
        const double across = std::hypot(dot(n, side), dot(n, up)), pi = std::numbers::pi;
        put("depth", i, depth);
        put("normal.x", i, n.x), put("normal.y", i, n.y), put("normal.z", i, n.z);
        put("uv.u", i, std::atan2(dot(n, up), dot(n, side)) / (2 * pi) + 0.5);
        put("uv.v", i, std::atan2(across, dot(n, pole)) / pi);
        if (!derivatives) continue;
        const V east = cross(pole, n) / across, south = cross(east, n);
        const auto d = rays.derivative(p, n, x, y);
        for (const auto& [name, dp] : {std::pair{"duv_dx", d.dp_dx}, {"duv_dy", d.dp_dy}}) {
            put(std::string(name) + ".u", i, dot(east, dp) / (2 * pi * radius * across));
            put(std::string(name) + ".v", i, dot(south, dp) / (pi * radius));
        }
    }
    return frame;
}

TEST(UvNeighbours, FollowASurfaceThatCurvesAway) {
    const Camera camera = reference::test_camera();
    const Size size{160, 120};
    const HostFrame frame = ball_frame(camera, size, false), known = ball_frame(camera, size, true);
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].name = "swell", scene.layers[0].footprint = false;
    scene.layers[0].bump = HeightMapLayer{.texture = {.file = data_folder / "textures/swell_height.png"}};
    scene.output.surface_gradient = scene.output.marked = true;
    const Pixels found = evaluate_on(frame, scene), exact = evaluate_on(known, scene);
    const CameraRays<double> rays(camera, size);
    std::vector<double> inner, rim;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const V n = vec_at(frame.pixels, "normal", i), want = vec_at(exact, "surface_gradient", i);
        const V p =
            rays.at_depth(double(i % size.width) + 0.5, double(i / size.width) + 0.5, frame.pixels.at("depth")[i]);
        const double cosine = dot(n, normalize(p * -1.0));
        // Near the pole longitude is undefined.
        if (found.at("marked")[i] != 0 || cosine > 0.95 || length(want) < 0.02) continue;
        const double error = length(vec_at(found, "surface_gradient", i) - want) / length(want);
        (cosine < 0.35 ? rim : inner).push_back(error);
    }
    ASSERT_GT(rim.size(), 200u);
    expect_within("inside of the outline", Spread(inner), {1e-3, 6e-3, 0.08}, "relative");
    expect_within("at the outline", Spread(rim), {4e-3, 0.1, 0.2}, "relative");
}

}  // namespace
}  // namespace wrinkle::test
