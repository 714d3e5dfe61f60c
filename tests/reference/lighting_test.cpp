// Reflectance is reciprocal and loses no more energy than single scattering does, and lights fall off as they should.
#include "tests/reference/lighting.h"
#include "tests/reference/relit.h"

#include <gtest/gtest.h>

namespace wrinkle::reference {
namespace {

using V = Vec<real>;

V on_hemisphere(real cos_theta, real phi) {
    const real s = std::sqrt(1 - cos_theta * cos_theta);
    return {s * std::cos(phi), s * std::sin(phi), cos_theta};
}

/// Integral of brdf * n.l over the hemisphere, midpoint rule.
V albedo_of(const Surface<real>& s, V v) {
    const int steps = 200;
    V sum;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const real c = (i + 0.5L) / steps, phi = 2 * std::numbers::pi_v<real> * (j + 0.5L) / steps;
            sum = sum + brdf(V{0, 0, 1}, v, on_hemisphere(c, phi), s) * c;
        }
    return sum * (2 * std::numbers::pi_v<real> / (real(steps) * steps));
}

TEST(Lighting, ReflectanceIsReciprocal) {
    const Surface<real> s{{0.2L, 0.5L, 0.8L}, 0.4L, 0.04L};
    for (int i = 1; i < 20; ++i) {
        const V v = on_hemisphere(i / 20.0L, i * 1.3L), l = on_hemisphere(1 - i / 25.0L, i * 2.9L);
        EXPECT_LE(relative_error(brdf(V{0, 0, 1}, v, l, s), brdf(V{0, 0, 1}, l, v, s)), 1e-15L);
    }
}

TEST(Lighting, WhiteFurnace) {
    for (const real roughness : {0.3L, 0.5L, 0.8L, 1.0L})
        for (const real c : {0.3L, 0.7L, 1.0L}) {
            const real mirror = albedo_of({{}, roughness, 1}, on_hemisphere(c, 0.4L)).x;
            EXPECT_LE(mirror, 1.001L) << roughness << " " << c;
            EXPECT_GE(mirror, 0.3L) << roughness << " " << c;
        }
    EXPECT_NEAR(albedo_of({{}, 0.3L, 1}, {0, 0, 1}).x, 0.99L, 0.01L);
    // alpha = 1 seen along the normal has the closed form 1 - ln 2.
    EXPECT_NEAR(albedo_of({{}, 1, 1}, {0, 0, 1}).x, 1 - std::numbers::ln2_v<real>, 1e-5L);
    const V diffuse = albedo_of({{0.5L, 0.25L, 1}, 1, 0}, {0, 0, 1}) - albedo_of({{}, 1, 0}, {0, 0, 1});
    EXPECT_LE(length(diffuse - V{0.5L, 0.25L, 1}), 1e-5L);
}

TEST(Lighting, SunIsLambertPlusSpecular) {
    Lighting lighting;
    lighting.ambient = {0.1, 0.2, 0.3};
    lighting.lights = {{LightKind::sun, {1, 1, 1}, 2, {}, {0, 0, -3}, 0, 0}};
    const Surface<real> s{{0.5L, 0.5L, 0.5L}, 1, 0};
    const real got = lit(lighting, V{0, 0, 1}, V{0, 0, 1}, V{}, s).x;
    // n = v = l: f0 = 0 leaves no specular reflection.
    EXPECT_NEAR(got, 0.5L * 0.1L + 2 * 0.5L / std::numbers::pi_v<real>, 1e-15L);
    EXPECT_NEAR(lit(lighting, V{0, 0, -1}, V{0, 0, 1}, V{}, s).y, 0.5L * 0.2L, 1e-15L);
}

TEST(Lighting, PointAndSpotFallOff) {
    Light light{LightKind::point, {1, 2, 3}, 8, {0, 0, 2}, {0, 0, -1}, 0.2, 0.4};
    EXPECT_NEAR(arrival(light, V{}).irradiance.y, 4, 1e-18L);
    light.kind = LightKind::spot;
    EXPECT_NEAR(arrival(light, V{}).irradiance.y, 4, 1e-18L);
    EXPECT_EQ(arrival(light, V{2 * std::tan(0.41L), 0, 0}).irradiance.y, 0);
    const real middle = (std::cos(0.2L) + std::cos(0.4L)) / 2, x = 2 * std::tan(std::acos(middle));
    EXPECT_NEAR(arrival(light, V{x, 0, 0}).irradiance.x, 8 / (4 + x * x) / 2, 1e-15L);
}

TEST(Lighting, BumpsAreDarkBehindTheSurfaceAndNeverMirrorWhatIsBelowIt) {
    const V base{0, 0, 1}, light = normalize(V{1, 0, -0.05L}), low = normalize(V{1, 0, 0.05L});
    EXPECT_EQ(terminator(normalize(V{0.5L, 0, 1}), base, light), 0);
    EXPECT_EQ(terminator(base, base, low), 1);
    EXPECT_GT(terminator(normalize(V{0.5L, 0, 1}), base, low), 0);
    EXPECT_LT(terminator(normalize(V{0.5L, 0, 1}), base, low), 0.3L);
    for (int i = 1; i < 40; ++i) {
        const V v = on_hemisphere(i / 40.0L, i * 1.7L), n = normalize(base + on_hemisphere(0, i * 0.9L) * 0.8L);
        const V mirror = mirror_normal(n, base, v), reflected = mirror * (2 * dot(mirror, v)) - v;
        EXPECT_GE(reflected.z, std::min(0.9L * v.z, 0.01L) - 1e-15L) << i;
        EXPECT_NEAR(length(mirror), 1, 1e-15L);
        EXPECT_LE(std::abs(dot(cross(base, n), mirror)), 1e-15L) << "in the plane of both";
        EXPECT_EQ(length(mirror_normal(base, base, v) - base), 0);
    }
}

TEST(Lighting, SkyOfOneColourLightsAllNormalsAlike) {
    Lighting lighting;
    Light sky{.kind = LightKind::sky};
    sky.zenith = sky.horizon = sky.ground = {1, 2, 3}, sky.intensity = 2;
    lighting.lights = {sky};
    for (int i = 0; i < 20; ++i) {
        const V n = on_hemisphere(i / 20.0L, i * 1.1L);
        EXPECT_LE(length(sky_light(lighting, n, n) - V{2, 4, 6}), 1e-15L);
        const V base = on_hemisphere(0, i * 1.1L);
        EXPECT_LE(length(sky_light(lighting, n, base) - V{2, 4, 6} * sky_keeps(n, base)), 1e-15L);
    }
    // A sky that is dark below: half of it reaches an upright wall. Order 2 is exact for that.
    lighting.lights[0].ground = {};
    EXPECT_NEAR(sky_light(lighting, V{1, 0, 0}, V{1, 0, 0}).x, 1, 1e-15L);
    EXPECT_NEAR(sky_light(lighting, V{0, 0, 1}, V{0, 0, 1}).x, 2, 1e-15L);
}

/// Of light from all around alike, by the cosine: what a bumped surface gets in front of its base, and what of that the
/// terminator keeps.
std::pair<real, real> in_front_and_kept(V n, V base) {
    constexpr int steps = 300;
    real front = 0, kept = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const V l = on_hemisphere((i + 0.5L) / steps, std::numbers::pi_v<real> * (j + 0.5L) / steps);
            const real share = std::max(dot(n, l), 0.0L) / (steps * steps);
            if (dot(base, l) > 0) front += share, kept += share * terminator(n, base, l);
        }
    return {front, kept};
}

TEST(Lighting, BumpsTakeAPartOfTheSky) {
    const V base{0, 0, 1};
    for (const real angle : {0.0L, 0.02L, 0.1L, 0.3L, 0.6L, 1.0L, 1.4L, 1.57L, 1.8L, 2.5L, 3.1L}) {
        const V n{std::sin(angle), 0, std::cos(angle)};
        const auto [front, kept] = in_front_and_kept(n, base);
        EXPECT_NEAR(front, (1 + n.z) / 2, 1e-4L);
        EXPECT_NEAR(sky_keeps(n, base), 0.45L * front + 0.55L * kept, 6e-4L) << angle;
    }
}

TEST(Lighting, RatioIsBounded) {
    EXPECT_EQ(relight_ratio(1.0L, 1.0L, 4.0L), 1);
    EXPECT_EQ(relight_ratio(1.0L, 0.0L, 4.0L), 4);
    EXPECT_EQ(relight_ratio(0.0L, 1.0L, 4.0L), 0.25L);
    EXPECT_EQ(relight_ratio(0.0L, 0.0L, 4.0L), 1);
}

TEST(Lighting, PicturesChangeByWhatTheyShowOfALight) {
    Lighting lighting;
    lighting.ambient = {0.25, 0.25, 0.25};
    lighting.max_ratio = 100;
    lighting.shadows = Shadows::read;
    const V one{1, 1, 1};
    Relit<real> relit{one, {}, {{}, one, one * 0.5L}, {{}, one * 0.25L, one * 0.25L}};
    // Albedo 1: of the picture .25 is the sky's, .5 the lamps' (all of what they give), which doubles.
    EXPECT_NEAR(relit.picture(lighting, one).x, 1.5L, 1e-3L);
    relit.beauty = one * 0.25L;  // in their shadow
    EXPECT_NEAR(relit.picture(lighting, one).x, 0.25L, 1e-15L);
    relit.beauty = one, relit.others = {};
    relit.own = {{one * 0.75L, one, one * 0.5L}};
    EXPECT_NEAR(relit.picture(lighting, one).x, 1.75L, 1e-2L);               // a fiftieth of the sky beside the lamp
    relit.own[0].now = relit.own[0].old, relit.own[0].picture = one * 3.0L;  // shows more than there is
    EXPECT_NEAR(relit.picture(lighting, one).x, 1, 1e-15L);
}

}  // namespace
}  // namespace wrinkle::reference
