// The closed forms of displaced normals against finite differences of a sphere and a torus that are really displaced.
#include "tests/reference/displacement.h"

#include <gtest/gtest.h>

namespace wrinkle::reference {
namespace {

using V = Vec<real>;

/// A torus. It is a sphere when the radius of its ring is 0.
struct Torus {
    real ring, tube;

    V normal(real u, real v) const { return {std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)}; }
    V point(real u, real v) const { return V{std::cos(u), std::sin(u), 0} * ring + normal(u, v) * tube; }
};

template <class F>
auto derivative(const F& f) {
    const real h = 1e-4L;
    const auto central = [&](real e) { return (f(e) - f(-e)) * (1 / (2 * e)); };
    return central(h / 2) * (4.0L / 3) - central(h) * (1.0L / 3);
}

real height(real u, real v) { return 0.05L * std::sin(3 * u) * std::cos(2 * v); }

void expect_normals(const Torus& base) {
    for (const real u : {0.1L, 1.3L, 4.0L})
        for (const real v : {-0.9L, 0.2L, 1.1L, 2.5L}) {
            const auto moved = [&](real a, real b) { return base.point(a, b) + base.normal(a, b) * height(a, b); };
            const V x = derivative([&](real e) { return moved(u + e, v); });
            const V y = derivative([&](real e) { return moved(u, v + e); });
            V want = normalize(cross(x, y));
            if (dot(want, base.normal(u, v)) < 0) want = -want;
            const V got =
                displaced_normal_curved(base.normal(u, v), derivative([&](real e) { return base.point(u + e, v); }),
                                        derivative([&](real e) { return base.point(u, v + e); }),
                                        derivative([&](real e) { return base.normal(u + e, v); }),
                                        derivative([&](real e) { return base.normal(u, v + e); }), height(u, v),
                                        derivative([&](real e) { return height(u + e, v); }),
                                        derivative([&](real e) { return height(u, v + e); }));
            EXPECT_LE(angle_degrees(got, want), 1e-8L) << u << ", " << v;
        }
}

TEST(Displacement, OfASphereHasItsNormal) { expect_normals({0, 1.5L}); }
TEST(Displacement, OfATorusHasItsNormal) { expect_normals({2, 0.5L}); }

/// The form that takes the base normal as constant is off by about slope * |h| / radius.
TEST(Displacement, WithoutCurvatureIsCloseWhereTheHeightIsSmall) {
    const Torus sphere{0, 1};
    const V k{5, -3, 4};  // h = s sin(k.p) as a function in space
    for (const real s : {1e-3L, 1e-5L}) {
        const real u = 0.4L, v = 0.3L;
        const auto h = [&](real a, real b) { return s * std::sin(dot(k, sphere.point(a, b))); };
        const auto moved = [&](real a, real b) { return sphere.point(a, b) + sphere.normal(a, b) * h(a, b); };
        const V want = normalize(cross(derivative([&](real e) { return moved(u + e, v); }),
                                       derivative([&](real e) { return moved(u, v + e); })));
        const V gradient = k * (s * std::cos(dot(k, sphere.point(u, v))));
        const real error = angle_degrees(displaced_normal(sphere.normal(u, v), gradient), want);
        EXPECT_LE(error, 57.3L * length(gradient) * s * 2);
        EXPECT_GT(error, 57.3L * length(gradient) * s * 0.001L);
    }
}

}  // namespace
}  // namespace wrinkle::reference
