// [filter] curvature: how a sphere's own normal turns within pixels, by brute force over each pixel.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

constexpr double kRadius = 0.7;
constexpr Size kSize{32, 24};

Camera camera() { return Camera::look_at({0, -4, 1}, {0, 0, 0}, {0, 0, 1}, 0.5, 4.0 / 3); }

/// Where the ray through an image point meets the sphere, relative to the eye; nothing beside it.
struct Hit {
    double depth;
    V normal;
};
std::optional<Hit> hit(const reference::CameraRays<double>& rays, double x, double y) {
    const V d = rays.at_depth(x, y, 1.0), eye = rays.eye();
    const double a = dot(d, d), b = dot(d, eye), root = b * b - a * (dot(eye, eye) - kRadius * kRadius);
    if (root <= 0) return std::nullopt;
    const double t = (-b - std::sqrt(root)) / a;
    return Hit{t, (eye + d * t) / kRadius};
}

HostFrame sphere(const reference::CameraRays<double>& rays) {
    HostFrame frame;
    frame.frame.size = kSize, frame.frame.camera = camera();
    frame.add("depth", 1e10f), frame.add("normal.x"), frame.add("normal.y"), frame.add("normal.z", 1);
    for (std::size_t i = 0; i < frame.count(); ++i)
        if (const auto at = hit(rays, double(i % kSize.width) + 0.5, double(i / kSize.width) + 0.5)) {
            frame.pixels["depth"][i] = static_cast<float>(at->depth);
            frame.pixels["normal.x"][i] = static_cast<float>(at->normal.x);
            frame.pixels["normal.y"][i] = static_cast<float>(at->normal.y);
            frame.pixels["normal.z"][i] = static_cast<float>(at->normal.z);
        }
    return frame;
}

TEST(Curvature, OfASphereIsTheCovarianceOfItsSlopes) {
    const reference::CameraRays<double> rays(camera(), kSize);
    const HostFrame frame = sphere(rays);
    Scene scene;
    Layer flat;
    flat.name = "flat", flat.bump = ConstantLayer{};
    scene.layers = {flat};
    scene.output = {.roughness = true, .slope_covariance = true};
    const Pixels without = evaluate_area(frame, scene);
    scene.filter.curvature = true;
    const Pixels got = evaluate_area(frame, scene);
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        EXPECT_EQ(without.at("slope_covariance.xx")[i], 0);
        const double x = double(i % kSize.width) + 0.5, y = double(i / kSize.width) + 0.5;
        const auto centre = hit(rays, x, y);
        if (!centre) {
            EXPECT_EQ(got.at("slope_covariance.xx")[i], 0);
            continue;
        }
        const V n = centre->normal, p = rays.at_depth(x, y, centre->depth);
        if (dot(n, normalize(p)) > -0.6) continue;  // neighbours are off the sphere, or far round it
        const V right = normalize(rays.derivative(p, n, x, y).dp_dx), down = cross(right, n);
        constexpr int points = 16;
        double s = 0, t = 0, ss = 0, st = 0, tt = 0;
        for (int k = 0; k < points * points; ++k) {
            const V m = hit(rays, x - 0.5 + (k % points + 0.5) / points, y - 0.5 + (k / points + 0.5) / points)->normal;
            const V g = n - m / dot(m, n);
            const double along = dot(g, right) / (points * points), across = dot(g, down) / (points * points);
            s += along, t += across;
            ss += along * dot(g, right), st += along * dot(g, down), tt += across * dot(g, down);
        }
        const double xx = ss - s * s, xy = st - s * t, yy = tt - t * t;
        for (const auto& [name, want] : {std::pair{"xx", xx}, {"xy", xy}, {"yy", yy}})
            errors.push_back(std::abs(got.at(std::string("slope_covariance.") + name)[i] - want) / (xx + yy));
        // alpha^2 grows by the variances, twice their mean; roughness is the root of alpha.
        const double alpha = scene.lighting.roughness * scene.lighting.roughness;
        const double found = double{got.at("slope_covariance.xx")[i]} + double{got.at("slope_covariance.yy")[i]};
        EXPECT_NEAR(got.at("roughness")[i], std::sqrt(std::sqrt(alpha * alpha + found)), 1e-5);
    }
    const Spread spread(errors);
    print("curvature of a sphere", spread, "of the variance");
    EXPECT_GT(spread.count, 200u);
    EXPECT_LT(spread.median, 0.01);
    EXPECT_LT(spread.p99, 0.04) << "differences over two pixels, where the sphere turns away";
}

/// The picture to relight shows the base surface's curvature already.
TEST(Curvature, LeavesLightAsItIs) {
    const HostFrame frame = sphere(reference::CameraRays<double>(camera(), kSize));
    for (const bool mean : {false, true}) {
        Scene scene;
        Layer noise;
        noise.name = "noise", noise.bump = NoiseLayer{.frequency = 3}, noise.scale = 0.02;
        scene.layers = {noise};
        scene.lighting.relight = Relight::lit;
        scene.lighting.lights = {{.direction = {0.3, 0.4, -0.8}}};
        scene.filter.light_mean = mean;
        scene.output.roughness = true;
        const Pixels without = evaluate_area(frame, scene);
        scene.filter.curvature = true;
        const Pixels with = evaluate_area(frame, scene);
        for (const char* part : {"lit.r", "lit.g", "lit.b"}) EXPECT_EQ(with.at(part), without.at(part)) << part;
        EXPECT_NE(with.at("roughness"), without.at("roughness"));
    }
}

}  // namespace
}  // namespace wrinkle::test
