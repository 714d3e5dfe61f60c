// Surface gradients are compared with the normals of surfaces that are really displaced, p + h n, which are found by
// numerical differentiation. On a plane, eq. 5 of [Mik20] is exact, so both must agree.
#include <gtest/gtest.h>

#include "tests/reference/resolve.h"
#include "tests/reference/scale_dependent.h"
#include "tests/reference/tangent_frame.h"
#include "tests/reference/tbn.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::reference {
namespace {

using V = Vec<real>;

/// The derivative of f at 0, by differences that are extrapolated to a step of 0.
template <class F>
V derivative(const F& f) {
    const auto central = [&](real h) { return (f(h) - f(-h)) / (2 * h); };
    const real h = 1e-4L;
    return (central(h / 2) * 4.0L - central(h)) / 3.0L;
}

/// A plane p(s,t) = o + a s + b t with a skewed, possibly mirrored parametrisation, seen on a screen whose (x, y) are a
/// linear map of (s, t), and a height over (s, t).
struct Case {
    V a, b, n;
    TexDerivative<real> st;
    V dp_dx, dp_dy;
};

Case make_case(int seed) {
    auto r = [k = seed * 100]() mutable { return std::sin(++k * 12.9898L) * 1.3L; };
    Case c;
    c.a = {r(), r(), r()};
    c.b = {r(), r(), r()};
    c.n = normalize(cross(c.a, c.b)) * (seed % 2 ? 1.0L : -1.0L);
    c.st = {{r(), r()}, {r(), r()}};
    c.dp_dx = c.a * c.st.dx.x + c.b * c.st.dx.y;
    c.dp_dy = c.a * c.st.dy.x + c.b * c.st.dy.y;
    return c;
}

/// Normal of the displaced surface at (s, t), on the side of n.
template <class H>
V displaced_normal(const Case& c, const H& height, real s, real t) {
    const auto point = [&](real s1, real t1) { return c.a * s1 + c.b * t1 + c.n * height(s1, t1); };
    const V ds = derivative([&](real e) { return point(s + e, t); });
    const V dt = derivative([&](real e) { return point(s, t + e); });
    const V n = normalize(cross(ds, dt));
    return dot(cross(c.a, c.b), c.n) < 0 ? -n : n;
}

TEST(DisplacedSurface, ScaleDependentGradientGivesItsNormal) {
    for (int seed = 1; seed <= 50; ++seed) {
        const Case c = make_case(seed);
        const auto h = [](real s, real t) { return std::sin(2 * s) * std::cos(3 * t) * 0.7L; };
        const real s = 0.3L + seed, t = 0.7L;
        const Vec2<real> dh{std::cos(2 * s) * std::cos(3 * t) * 1.4L, -std::sin(2 * s) * std::sin(3 * t) * 2.1L};
        const V g = surface_gradient_scale_dependent(c.n, c.dp_dx, c.dp_dy, c.st, dh);
        EXPECT_LE(angle_degrees(resolve(c.n, g), displaced_normal(c, h, s, t)), 1e-9L) << seed;
    }
}

TEST(DisplacedSurface, VolumeGradientGivesItsNormal) {
    for (int seed = 1; seed <= 50; ++seed) {
        const Case c = make_case(seed);
        const auto f = [](V p) { return std::sin(p.x) * std::cos(2 * p.y) + p.z * p.z; };
        const auto h = [&](real s, real t) { return f(c.a * s + c.b * t); };
        const V p = c.a * 0.2L + c.b * -0.4L;
        const V gradient{std::cos(p.x) * std::cos(2 * p.y), -2 * std::sin(p.x) * std::sin(2 * p.y), 2 * p.z};
        const V n = resolve(c.n, surface_gradient_from_volume(c.n, gradient));
        EXPECT_LE(angle_degrees(n, displaced_normal(c, h, 0.2L, -0.4L)), 1e-9L) << seed;
    }
}

/// When s and t are metres along orthonormal axes, the slopes of a tangent-space normal are those of the height.
TEST(DisplacedSurface, TbnGradientGivesItsNormalWhereTheUvIsOrthonormal) {
    for (int seed = 1; seed <= 50; ++seed) {
        Case c = make_case(seed);
        c.a = normalize(c.a);
        c.b = normalize(c.b - c.a * dot(c.a, c.b));
        c.dp_dx = c.a * c.st.dx.x + c.b * c.st.dx.y;
        c.dp_dy = c.a * c.st.dy.x + c.b * c.st.dy.y;
        const auto h = [](real s, real t) { return s * s + 0.5L * s * t; };
        const TangentFrame<real> frame = tangent_frame(c.n, c.dp_dx, c.dp_dy, c.st);
        ASSERT_FALSE(frame.degenerate);
        EXPECT_LE(length(frame.tangent - c.a), 1e-14L) << seed;
        EXPECT_LE(length(frame.bitangent - c.b), 1e-14L) << seed;
        const V g = surface_gradient_from_tbn({2 * 0.3L + 0.5L * 0.6L, 0.5L * 0.3L}, frame.tangent, frame.bitangent);
        EXPECT_LE(angle_degrees(resolve(c.n, g), displaced_normal(c, h, 0.3L, 0.6L)), 1e-9L) << seed;
    }
}

}  // namespace
}  // namespace wrinkle::reference
