// The geometry of cameras is tested by projecting it with the camera's matrices, derivatives by neighbouring rays.
#include "tests/reference/camera_rays.h"

#include <gtest/gtest.h>

#include "tests/reference/test_frame.h"

namespace wrinkle::reference {
namespace {

using V = Vec<real>;
constexpr Size size{64, 48};

/// Pixel position of an eye-relative point, by the definition: clip = proj * view * p.
Vec2<real> pixel_of(const Camera& camera, const CameraRays<real>& rays, V p) {
    const V world = p + rays.eye();
    Vec4<real> q{world.x, world.y, world.z, 1};
    for (const Mat4* m : {&camera.view, &camera.proj}) {
        Vec4<real> r{};
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) r[i] += real((*m)[i][j]) * q[j];
        q = r;
    }
    return {(q[0] / q[3] + 1) / 2 * size.width, (1 - q[1] / q[3]) / 2 * size.height};
}

/// The point that pixel position (x, y) sees on the plane through p perpendicular to n, found on the line through two
/// points of its ray.
V on_plane(const CameraRays<real>& rays, V p, V n, real x, real y) {
    const V a = rays.at_depth(x, y, 1), b = rays.at_depth(x, y, 2);
    return a + (b - a) * (dot(n, p - a) / dot(n, b - a));
}

class CameraRaysOf : public testing::TestWithParam<Camera> {};

TEST_P(CameraRaysOf, PointsProjectToTheirPixel) {
    const CameraRays<real> rays(GetParam(), size);
    for (const real z : {0.5L, 3.0L, 200.0L}) {
        const Vec2<real> xy = pixel_of(GetParam(), rays, rays.at_depth(13.5L, 40.5L, z));
        EXPECT_NEAR(xy.x, 13.5L, 1e-13L);
        EXPECT_NEAR(xy.y, 40.5L, 1e-13L);
    }
}

TEST_P(CameraRaysOf, DerivativesAreTheDifferencesOfNeighbouringRays) {
    const CameraRays<real> rays(GetParam(), size);
    const real x = 20.5L, y = 11.5L, h = 1e-4L;
    const V p = rays.at_depth(x, y, 4);
    for (const V n : {normalize(V{1, 2, 3}), normalize(V{-1, 0.3L, 0.1L}), normalize(V{0.1L, -1, 2})}) {
        const auto numeric = [&](real dx, real dy) {
            const auto central = [&](real e) {
                return (on_plane(rays, p, n, x + dx * e, y + dy * e) - on_plane(rays, p, n, x - dx * e, y - dy * e)) /
                       (2 * e);
            };
            return (central(h / 2) * 4.0L - central(h)) / 3.0L;
        };
        const ScreenDerivative<real> d = rays.derivative(p, n, x, y);
        EXPECT_LE(relative_error(d.dp_dx, numeric(1, 0)), 1e-11L);
        EXPECT_LE(relative_error(d.dp_dy, numeric(0, 1)), 1e-11L);
        EXPECT_NEAR(dot(d.dp_dx, n), 0, 1e-15L);
        EXPECT_NEAR(dot(d.dp_dy, n), 0, 1e-15L);
    }
}

TEST(CameraRays, ParallelProjectionsAreSeenFromOneSide) {
    const CameraRays<real> pinhole(test_camera(), size), parallel(orthographic_camera(), size);
    const V back = normalize(V{1, -6, 4});
    for (const real x : {0.5L, 63.5L}) {
        EXPECT_LE(angle_degrees(parallel.view(parallel.at_depth(x, 7.5L, 3), x, 7.5L), back), 1e-13L);
        const V p = pinhole.at_depth(x, 7.5L, 3);
        EXPECT_LE(angle_degrees(pinhole.view(p, x, 7.5L), -p), 1e-13L);
    }
}

TEST(CameraRays, TellsPinholesFromTheRest) {
    EXPECT_TRUE(CameraRays<real>(test_camera(), size).pinhole());
    EXPECT_TRUE(CameraRays<real>(shifted_camera(), size).pinhole());
    EXPECT_FALSE(CameraRays<real>(orthographic_camera(), size).pinhole());
    EXPECT_FALSE(CameraRays<real>(tilted_camera(), size).pinhole());
}

TEST(CameraRays, DistanceIsAlongTheRay) {
    const CameraRays<real> rays(test_camera(), size);
    EXPECT_NEAR(length(rays.at_distance(3.5L, 7.5L, 12)), 12, 1e-16L);
    EXPECT_LE(angle_degrees(rays.at_distance(3.5L, 7.5L, 12), rays.at_depth(3.5L, 7.5L, 1)), 1e-16L);
}

INSTANTIATE_TEST_SUITE_P(Cameras, CameraRaysOf,
                         testing::Values(test_camera(), shifted_camera(), orthographic_camera(), tilted_camera()));

}  // namespace
}  // namespace wrinkle::reference
