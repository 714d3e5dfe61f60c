// Planar mapping: the chain rule gives the same as the closed form.
#include <gtest/gtest.h>

#include "tests/reference/object_scale.h"
#include "tests/reference/scale_dependent.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::reference {
namespace {

using V = Vec<real>;

/// ["Exploring the Surface Gradient" eq. 13, 44] For slopes along a projection onto the x-y plane with tiling (a, b),
/// the surface gradient is [1 - n_x^2, -n_x n_y, -n_x n_z | -n_x n_y, 1 - n_y^2, -n_y n_z] (a h_s, b h_t). It depends
/// neither on dp_dx and dp_dy nor on the translation.
TEST(Planar, SurfaceGradientIsTheClosedForm) {
    const V n = normalize(V{0.3L, -0.4L, 0.6L});
    const V dp_dx = tangent_part(V{0.01L, 0.02L, -0.005L}, n), dp_dy = tangent_part(V{-0.03L, 0.01L, 0.02L}, n);
    const Vec2<real> tiling{2, -3}, dh_dst{0.7L, 0.2L};
    const auto step = [&](V dp) { return Vec2<real>{tiling.x * dp.x, tiling.y * dp.y}; };
    const V got = surface_gradient_scale_dependent(n, dp_dx, dp_dy, {step(dp_dx), step(dp_dy)}, dh_dst);
    const real s = tiling.x * dh_dst.x, t = tiling.y * dh_dst.y;
    const V want = V{1 - n.x * n.x, -n.x * n.y, -n.x * n.z} * s + V{-n.x * n.y, 1 - n.y * n.y, -n.y * n.z} * t;
    EXPECT_LE(relative_error(got, want), 1e-16L);
    EXPECT_LE(relative_error(surface_gradient_from_volume(n, V{s, t, 0}), want), 1e-16L);
}

/// A bump on a mirrored object is the mirror image of the bump: sign(det M) cof(M), not cof(M).
TEST(ObjectScale, MirroringMirrorsTheBump) {
    const V n = normalize(V{0.3L, -0.4L, 0.6L}), g = tangent_part(V{0.2L, 0.5L, 0.1L}, n);
    const Columns3<real> mirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_LE(length(resolve_object(mirror, n, g) - mirror * resolve(n, g)), 1e-17L);
    const Columns3<real> stretched{{2, 0, 0}, {0, 1, 0}, {0, 0, -0.5L}};
    const V cofactors = V{(n - g).x * -0.5L, (n - g).y * -1, (n - g).z * 2};
    EXPECT_LE(length(resolve_object(stretched, n, g) + normalize(cofactors)), 1e-17L);
    const V world = resolve_object(stretched, n, V{});
    EXPECT_LE(length(resolve(world, surface_gradient_to_world(stretched, n, g)) - resolve_object(stretched, n, g)),
              1e-17L);
}

}  // namespace
}  // namespace wrinkle::reference
