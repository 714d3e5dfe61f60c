// Lights that are known, seen on surfaces with shadows, noise and outliers, and found again.
#include "tools/light_fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/reference/lighting.h"
#include "tools/frame_lights.h"
#include "wrinkle/error.h"

namespace wrinkle::test {
namespace {

using reference::real;
using V = reference::Vec<real>;

/// Surfaces that face every way, or upwards only, under the lights of a scene by the reference: white, without bumps.
struct Seen {
    std::vector<Light> lights;
    double shadowed = 0.3;   ///< share of the surfaces that no sun reaches
    double noise = 0.03;     ///< of the radiance
    double outliers = 0.08;  ///< share of the surfaces that show something else
    bool upwards = false;
    bool placed = false;  ///< in a room of 4 x 4 x 2 metres, which the surfaces fill

    std::vector<SeenSurface> surfaces(std::size_t count) const {
        std::mt19937 random(7);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> uniform;
        Lighting all, sky;
        all.lights = lights;
        for (const Light& light : lights)
            if (light.kind == LightKind::sky) sky.lights.push_back(light);
        const reference::Surface<real> white{{1, 1, 1}, 1, 0};
        std::vector<SeenSurface> out;
        while (out.size() < count) {
            V n = normalize(V{normal(random), normal(random), normal(random)});
            if (upwards) n.z = std::abs(n.z);
            const bool dark = uniform(random) < shadowed;
            V at{};
            if (placed) at = {4 * uniform(random) - 2, 4 * uniform(random) - 2, 2 * uniform(random)};
            // White, f0 = 0, seen from above: the grazing specular is none where the view is the normal.
            V shown = reference::lit(dark ? sky : all, n, n, n, at, white);
            const real glow = uniform(random) < outliers ? 2 * uniform(random) : 0;
            shown = shown * real(1 + noise * normal(random)) + V{glow, glow, glow};
            const auto array = [](const V& v) { return Vec3{double(v.x), double(v.y), double(v.z)}; };
            out.push_back({array(n), array(shown), placed ? std::optional(array(at)) : std::nullopt});
        }
        return out;
    }
};

Light two_colours() {
    Light sky{.kind = LightKind::sky};
    sky.zenith = {0.2, 0.35, 0.7}, sky.horizon = {0.6, 0.6, 0.55}, sky.ground = {0.2, 0.15, 0.1};
    return sky;
}

Light sun(Vec3 direction, double intensity, Vec3 color = {1, 0.9, 0.8}) {
    return Light{.color = color, .intensity = intensity, .direction = direction};
}

double degrees_between(const Vec3& a, const Vec3& b) {
    return reference::angle_degrees(V{a[0], a[1], a[2]}, V{b[0], b[1], b[2]});
}

/// The largest difference of what two skies give to any surface, as a share of the largest that one gives.
double sky_error(const Light& got, const Light& wanted) {
    Lighting a, b;
    a.lights = {got}, b.lights = {wanted};
    double worst = 0, most = 0;
    for (int i = 0; i < 200; ++i) {
        const real z = 1 - (2 * i + 1) / 200.0L, r = std::sqrt(1 - z * z);
        const V n{r * std::cos(2.4L * i), r * std::sin(2.4L * i), z};
        const V x = reference::sky_light(a, n, n), y = reference::sky_light(b, n, n);
        worst = std::max(worst, double(length(x - y))), most = std::max(most, double(length(y)));
    }
    return worst / most;
}

TEST(LightFit, FindsASunInItsShadowsAndTheSky) {
    for (const bool upwards : {false, true}) {
        const Seen seen{.lights = {two_colours(), sun({0.7, 0.48, -0.53}, 3.4)}, .upwards = upwards};
        const LightFit fit = fit_lights(seen.surfaces(3000));
        ASSERT_EQ(fit.lights.size(), 2u);
        const double off = degrees_between(fit.lights[1].direction, seen.lights[1].direction);
        fmt::print(
            "sun {:.2f} degrees off, loose by {}, intensity {:.3f}, shadowed {:.2f}; sky {:.3f}; median {:.3f}\n", off,
            fit.loose[0], fit.lights[1].intensity, fit.shadowed[0], sky_error(fit.lights[0], seen.lights[0]),
            fit.median);
        EXPECT_LE(off, 2);
        EXPECT_NEAR(fit.lights[1].intensity, 3.4, 0.17);
        EXPECT_NEAR(fit.shadowed[0], 0.3, 0.08);
        EXPECT_LE(sky_error(fit.lights[0], seen.lights[0]), upwards ? 0.4 : 0.1) << "nothing shows the ground";
        EXPECT_LE(fit.median, 0.06);
        EXPECT_EQ(fit.surfaces, 3000u);
    }
}

TEST(LightFit, FindsTwoSuns) {
    const Seen seen{.lights = {two_colours(), sun({0.7, 0.48, -0.53}, 3), sun({-0.8, 0.3, -0.4}, 2, {0.5, 0.7, 1})}};
    const LightFit fit = fit_lights(seen.surfaces(3000));
    ASSERT_EQ(fit.lights.size(), 3u);
    for (const std::size_t i : {1u, 2u})
        EXPECT_LE(degrees_between(fit.lights[i].direction, seen.lights[i].direction), 4) << i;
    EXPECT_GE(fit.lights[1].intensity, fit.lights[2].intensity) << "the strongest first";
}

double metres_between(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(LightFit, FindsAPointByHowItsLightFallsOff) {
    for (const Vec3 place : {Vec3{0.6, -0.8, 2.5}, Vec3{0.2, 0.3, 0.9}}) {
        const Light lamp{.kind = LightKind::point, .color = {1, 0.9, 0.7}, .intensity = 8, .position = place};
        const Seen seen{.lights = {two_colours(), lamp}, .placed = true};
        const LightFit fit = fit_lights(seen.surfaces(1500));
        ASSERT_EQ(fit.lights.size(), 2u);
        ASSERT_EQ(fit.lights[1].kind, LightKind::point);
        const double off = metres_between(fit.lights[1].position, place);
        fmt::print("point {:.3f} m off, loose by {:.3f}, intensity {:.2f}, shadowed {:.2f}, median {:.3f}\n", off,
                   fit.loose[0], fit.lights[1].intensity, fit.shadowed[0], fit.median);
        EXPECT_LE(off, 0.15);
        EXPECT_NEAR(fit.lights[1].intensity, 8, 0.8);
        EXPECT_NEAR(fit.shadowed[0], 0.3, 0.08);
    }
}

TEST(LightFit, FindsASunBesideAPoint) {
    const Light lamp{.kind = LightKind::point, .intensity = 8, .position = {0.6, -0.8, 2.5}};
    const Seen seen{.lights = {two_colours(), lamp, sun({0.7, 0.48, -0.53}, 2)}, .placed = true};
    const LightFit fit = fit_lights(seen.surfaces(1500));
    ASSERT_EQ(fit.lights.size(), 3u);
    const std::size_t point = fit.lights[1].kind == LightKind::point ? 1 : 2;
    ASSERT_EQ(fit.lights[point].kind, LightKind::point);
    ASSERT_EQ(fit.lights[3 - point].kind, LightKind::sun);
    EXPECT_LE(metres_between(fit.lights[point].position, lamp.position), 0.3);
    EXPECT_LE(degrees_between(fit.lights[3 - point].direction, {0.7, 0.48, -0.53}), 6);
}

TEST(LightFit, ASunIsNoPointWhereSurfacesHavePlaces) {
    const Seen seen{.lights = {two_colours(), sun({0.7, 0.48, -0.53}, 3.4)}, .placed = true};
    const LightFit fit = fit_lights(seen.surfaces(1500));
    ASSERT_EQ(fit.lights.size(), 2u);
    EXPECT_EQ(fit.lights[1].kind, LightKind::sun);
    EXPECT_LE(degrees_between(fit.lights[1].direction, {0.7, 0.48, -0.53}), 2);
}

TEST(LightFit, ADullDayHasNoSun) {
    const Seen seen{.lights = {two_colours()}};
    const LightFit fit = fit_lights(seen.surfaces(2000));
    EXPECT_EQ(fit.lights.size(), 1u);
    EXPECT_LE(sky_error(fit.lights[0], seen.lights[0]), 0.1);
}

TEST(LightFit, RefusesWhatTellsNothing) {
    const Seen seen{.lights = {two_colours()}};
    std::vector<SeenSurface> all = seen.surfaces(1000);
    const auto refusal = [](const std::vector<SeenSurface>& surfaces) -> std::string {
        try {
            fit_lights(surfaces);
        } catch (const Error& error) { return error.what(); }
        return "nothing was refused";
    };
    EXPECT_NE(refusal({all.begin(), all.begin() + 100}).find("100 pixels"), std::string::npos);
    std::vector<SeenSurface> flat = all, black = all;
    for (SeenSurface& s : flat) s.normal = {0, 0, 1};
    for (SeenSurface& s : black) s.radiance = {};
    EXPECT_NE(refusal(flat).find("face the same way"), std::string::npos);
    EXPECT_NE(refusal(black).find("black"), std::string::npos);
}

TEST(FrameLights, OfARenderedFrameAreThoseItWasRenderedWith) {
    const Scene scene = load_scene(std::filesystem::path(WRINKLE_SOURCE_DIR) / "bench/picture/relit.toml");
    const FrameLights lights = lights_of_frame(scene, 0);
    fmt::print("{}\n{}", summary(lights), lights_as_toml(lights));
    ASSERT_EQ(lights.fit.lights.size(), 2u);
    EXPECT_TRUE(lights.albedo);
    EXPECT_LE(degrees_between(lights.fit.lights[1].direction, scene.lighting.lights[0].direction), 6);
    EXPECT_NEAR(lights.fit.lights[1].intensity, 3.4, 0.7);
    const Scene lit = with_lights(scene, {.all = lights});
    EXPECT_EQ(lit.lighting.shadows, Shadows::read);
    EXPECT_EQ(lit.lighting.lights.size(), 2u);
    EXPECT_FALSE(wants_lights(scene)) << "its sun has a picture of its own";
}

/// The torus and its known sun, without its own picture and without a sky.
Scene named_sun() {
    Scene scene = load_scene(std::filesystem::path(WRINKLE_SOURCE_DIR) / "bench/picture/relit.toml");
    scene.lighting.lights.resize(1);
    scene.lighting.lights[0].picture.clear();
    return scene;
}

TEST(FrameLights, AreBroughtIntoThePicturesUnits) {
    Scene scene = named_sun();
    const double renders = scene.lighting.lights[0].intensity;
    for (const double unit : {1.0, 0.01, 40.0}) {
        scene.lighting.lights[0].intensity = renders * unit;
        ASSERT_TRUE(wants_lights(scene));
        const FoundLights found = find_lights(scene, 0);
        fmt::print("{}\n", summary(found));
        ASSERT_TRUE(found.named.has_value()) << found.why_not;
        EXPECT_NEAR(found.named->scale * unit, 1, 0.15);
        const Scene lit = with_lights(scene, found);
        EXPECT_EQ(lit.lighting.shadows, Shadows::read);
        EXPECT_NEAR(lit.lighting.lights[0].intensity, renders, 0.15 * renders);
        ASSERT_EQ(lit.lighting.lights.size(), 2u) << "a sky was fitted beside it";
        EXPECT_EQ(lit.lighting.lights[1].kind, LightKind::sky);
        scene.lighting.ambient = {0.5 * unit, 0.5 * unit, 0.5 * unit};
        EXPECT_EQ(with_lights(scene, find_lights(scene, 0)).lighting.lights.size(), 1u) << "the scene has its own";
        scene.lighting.ambient = {};
    }
}

TEST(FrameLights, WhoseStrengthsContradictThePictureStayAsTheyAre) {
    Scene scene = load_scene(std::filesystem::path(WRINKLE_SOURCE_DIR) / "bench/picture/yard.toml");
    for (Light& light : scene.lighting.lights) light.picture.clear();
    ASSERT_TRUE(find_lights(scene, 0).named.has_value());
    scene.lighting.lights[1].intensity *= 4 * std::numbers::pi;  // the lamp in watts
    EXPECT_NE(find_lights(scene, 0).why_not.find("beside the others"), std::string::npos);
    for (Light& light : scene.lighting.lights) light.color = {};
    EXPECT_NE(find_lights(scene, 0).why_not.find("give no light"), std::string::npos);
}

TEST(FrameLights, ThatThePictureDoesNotShowStayAsTheyAre) {
    Scene scene = named_sun();
    for (double& x : scene.lighting.lights[0].direction) x = -x;  // from below
    const FoundLights found = find_lights(scene, 0);
    EXPECT_FALSE(found.named.has_value());
    EXPECT_NE(found.why_not.find("% are unexplained"), std::string::npos) << found.why_not;
    EXPECT_EQ(with_lights(scene, found).lighting.shadows, Shadows::automatic);
    scene.lighting.shadows = Shadows::ignored;
    EXPECT_FALSE(wants_lights(scene));
}

}  // namespace
}  // namespace wrinkle::test
