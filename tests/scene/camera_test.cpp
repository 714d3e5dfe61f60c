#include "wrinkle/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr Size size{641, 359};
using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 random_point(Random& random, double extent) {
    return {uniform(random, -extent, extent), uniform(random, -extent, extent), uniform(random, -extent, extent)};
}

Camera random_camera(Random& random, double offset) {
    const Vec3 eye = random_point(random, offset), way = random_point(random, 1);
    const Vec3 target{eye[0] + way[0], eye[1] + way[1], eye[2] + way[2]};
    Camera camera = Camera::look_at(eye, target, {0.1, 0.2, 1}, uniform(random, 0.1, 2.5), 16.0 / 9);
    camera.proj[0][2] = uniform(random, -0.5, 0.5);  // lens shift
    camera.proj[1][2] = uniform(random, -0.5, 0.5);
    return camera;
}

Vec3 along(const PinholeRays& rays, double x, double y, double z) {
    Vec3 out{};
    for (int i = 0; i < 3; ++i) out[i] = rays.eye[i] + z * (rays.d0[i] + x * rays.dx[i] + y * rays.dy[i]);
    return out;
}

/// The largest entry of a * b - identity, each relative to the sum of the magnitudes of its terms; in long double.
long double residual(const Mat4& a, const Mat4& b) {
    long double worst = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            long double sum = i == j ? -1 : 0, magnitude = 1;
            for (int k = 0; k < 4; ++k) {
                sum += static_cast<long double>(a[i][k]) * b[k][j];
                magnitude += std::abs(static_cast<long double>(a[i][k]) * b[k][j]);
            }
            worst = std::max(worst, std::abs(sum) / magnitude);
        }
    return worst;
}

constexpr Mat4 orthographic{{{0.1, 0, 0, 0}, {0, 0.2, 0, 0}, {0, 0, -0.02, -1}, {0, 0, 0, 1}}};

TEST(Camera, LookAtPutsTheTargetInTheMiddleAndUpUp) {
    const Camera camera = Camera::look_at({3, -4, 2}, {0, 1, 0.5}, {0, 0, 1}, 0.7, 2);
    const auto middle = project(camera, size, {0, 1, 0.5});
    ASSERT_TRUE(middle);
    EXPECT_NEAR((*middle)[0], size.width / 2.0, 1e-9);
    EXPECT_NEAR((*middle)[1], size.height / 2.0, 1e-9);
    const auto above = project(camera, size, {0, 1, 0.6});
    ASSERT_TRUE(above);
    EXPECT_NEAR((*above)[0], size.width / 2.0, 1e-9);
    EXPECT_LT((*above)[1], size.height / 2.0);
}

TEST(Camera, LookAtSpansTheFieldOfView) {
    // At distance 10 a vertical field of 60 degrees is 2 * 10 tan 30 high, and twice as wide at aspect 2.
    const Camera camera = Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, std::numbers::pi / 3, 2);
    const double half = 10 * std::tan(std::numbers::pi / 6);
    const auto corner = project(camera, {200, 100}, {2 * half, 10, half});
    ASSERT_TRUE(corner);
    EXPECT_NEAR((*corner)[0], 200, 1e-9);
    EXPECT_NEAR((*corner)[1], 0, 1e-9);
}

TEST(Camera, LookAtRefusesWhatHasNoDirection) {
    EXPECT_THROW(Camera::look_at({1, 2, 3}, {1, 2, 3}, {0, 0, 1}, 1, 1), Error);
    EXPECT_THROW(Camera::look_at({0, 0, 0}, {0, 0, 5}, {0, 0, -1}, 1, 1), Error);
    EXPECT_THROW(Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 0}, 1, 1), Error);
    EXPECT_THROW(Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0, 1), Error);
    EXPECT_THROW(Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 4, 1), Error);
    EXPECT_THROW(Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 0), Error);
    EXPECT_THROW(Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, std::nan(""), 1), Error);
}

TEST(Camera, RaysProjectToTheirPixelAndHaveViewDepthOne) {
    Random random(1);
    for (const double offset : {0.0, 10.0, 1e4, 1e6})
        for (int i = 0; i < 200; ++i) {
            const Camera camera = random_camera(random, offset);
            const auto rays = pinhole_rays(camera, size);
            ASSERT_TRUE(rays);
            const double x = uniform(random, 0, size.width), y = uniform(random, 0, size.height);
            const double z = std::exp(uniform(random, 0, 9));
            const Vec3 point = along(*rays, x, y, z);
            const auto pixel = project(camera, size, point);
            ASSERT_TRUE(pixel);
            const double rounding = 1e-8 + 1e-12 * offset * size.width * camera.proj[1][1];
            EXPECT_NEAR((*pixel)[0], x, rounding);
            EXPECT_NEAR((*pixel)[1], y, rounding);
            const auto& back = camera.view[2];
            EXPECT_NEAR(-(back[0] * point[0] + back[1] * point[1] + back[2] * point[2] + back[3]), z,
                        1e-9 + 1e-12 * z + 1e-15 * 4 * offset);
        }
}

TEST(Camera, RaysOfAKnownCamera) {
    // Identity view, 90 degrees, square: pixel (0,0) of a 2x2 frame sees (-1, 1, -1), a pixel is 1 wide at depth 1.
    Camera camera = Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, std::numbers::pi / 2, 1);
    const auto rays = pinhole_rays(camera, {2, 2});
    ASSERT_TRUE(rays);
    const Vec3 d0{-1, 1, -1}, dx{1, 0, 0}, dy{0, -1, 0};
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(rays->eye[i], 0, 1e-15);
        EXPECT_NEAR(rays->d0[i], d0[i], 1e-14);
        EXPECT_NEAR(rays->dx[i], dx[i], 1e-14);
        EXPECT_NEAR(rays->dy[i], dy[i], 1e-14);
    }
}

TEST(Camera, ObliqueNearPlaneKeepsThePinhole) {
    // The near plane only changes the third row of proj: neither the eye nor planar depth depend on it.
    Camera camera = Camera::look_at({1, 2, 3}, {4, 6, 3}, {0, 0, 1}, 1, 1);
    const auto plain = pinhole_rays(camera, size);
    camera.proj[2] = {0.3, -0.2, -1.5, -0.7};
    const auto oblique = pinhole_rays(camera, size);
    ASSERT_TRUE(plain && oblique);
    EXPECT_EQ(plain->eye, oblique->eye);
    EXPECT_EQ(plain->d0, oblique->d0);
}

TEST(Camera, DepthConventionsChangeNeitherRaysNorPixels) {
    const double near_plane = 0.1, far_plane = 500;
    const Vec3 point{4.5, 6.2, 3.4};
    Camera camera = Camera::look_at({1, 2, 3}, {4, 6, 3}, {0, 0, 1}, 1, 16.0 / 9);
    const auto plain = pinhole_rays(camera, size);
    const auto pixel = project(camera, size, point);
    ASSERT_TRUE(plain && pixel);
    const std::array<double, 4> conventions[] = {
        {0, 0, -(far_plane + near_plane) / (far_plane - near_plane),
         -2 * far_plane * near_plane / (far_plane - near_plane)},                                           // -1 to 1
        {0, 0, -far_plane / (far_plane - near_plane), -far_plane * near_plane / (far_plane - near_plane)},  // 0 to 1
        {0, 0, near_plane / (far_plane - near_plane), far_plane * near_plane / (far_plane - near_plane)},   // 1 to 0
        {0, 0, -1, -2 * near_plane},                                                                        // infinite
        {0, 0, 0, near_plane},  // 1 to 0 at infinity
    };
    for (const auto& depth : conventions) {
        camera.proj[2] = depth;
        const auto rays = pinhole_rays(camera, size);
        ASSERT_TRUE(rays);
        EXPECT_EQ(rays->eye, plain->eye);
        EXPECT_EQ(rays->d0, plain->d0);
        EXPECT_EQ(rays->dx, plain->dx);
        EXPECT_EQ(rays->dy, plain->dy);
        EXPECT_EQ(project(camera, size, point), pixel);
        const Mat4 clip = multiply(camera.proj, camera.view);
        EXPECT_LT(residual(clip, inverse(clip)), 1e-13L);
    }
}

TEST(Camera, NoRaysWithoutAnEye) {
    Camera camera = Camera::look_at({1, 2, 3}, {4, 6, 3}, {0, 0, 1}, 1, 1);
    const Mat4 perspective = camera.proj;
    camera.proj = orthographic;
    EXPECT_FALSE(pinhole_rays(camera, size));
    camera.proj = perspective;
    camera.proj[3] = {0, 0.1, -1, 0};  // w is no longer the depth along the viewing axis
    EXPECT_FALSE(pinhole_rays(camera, size));
    camera.proj = perspective;
    camera.proj[0][3] = 0.1;  // the eye is not the origin of view space
    EXPECT_FALSE(pinhole_rays(camera, size));
    camera.proj = perspective;
    camera.proj[0] = {};
    EXPECT_FALSE(pinhole_rays(camera, size));
    camera.proj = perspective;
    EXPECT_FALSE(pinhole_rays(camera, {0, 10}));
    EXPECT_TRUE(pinhole_rays(camera, size));
}

TEST(Camera, ProjectLeavesOutWhatIsBehindTheEye) {
    const Camera camera = Camera::look_at({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1, 1);
    EXPECT_TRUE(project(camera, size, {0, 1e-6, 0}));
    EXPECT_FALSE(project(camera, size, {0, 0, 0}));
    EXPECT_FALSE(project(camera, size, {0, -1, 0}));
    EXPECT_FALSE(project(camera, size, {1, 0, 0}));
    EXPECT_FALSE(project(camera, size, {std::nan(""), 1, 0}));
    EXPECT_FALSE(project(camera, size, {0, INFINITY, 0}));
}

TEST(Camera, ProjectOrthographic) {
    Camera camera = Camera::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1, 1);
    camera.proj = orthographic;
    const auto pixel = project(camera, {200, 100}, {5, -2.5, -100});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR((*pixel)[0], 150, 1e-9);
    EXPECT_NEAR((*pixel)[1], 75, 1e-9);
}

TEST(Matrix, MultiplyActsFromTheLeft) {
    const Mat4 move{{{1, 0, 0, 5}, {0, 1, 0, 6}, {0, 0, 1, 7}, {0, 0, 0, 1}}};
    const Mat4 grow{{{2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 4, 0}, {0, 0, 0, 1}}};
    const Mat4 expected{{{2, 0, 0, 5}, {0, 3, 0, 6}, {0, 0, 4, 7}, {0, 0, 0, 1}}};
    EXPECT_EQ(multiply(move, grow), expected);
}

TEST(Matrix, InverseHasASmallResidual) {
    Random random(2);
    for (const double offset : {0.0, 1.0, 1e4, 1e8})
        for (int i = 0; i < 200; ++i) {
            const Camera camera = random_camera(random, offset);
            EXPECT_LT(residual(camera.view, inverse(camera.view)), 1e-14L);
            EXPECT_LT(residual(camera.proj, inverse(camera.proj)), 1e-14L);
        }
    for (int i = 0; i < 500; ++i) {
        Mat4 m{};
        for (auto& row : m)
            for (double& x : row) x = uniform(random, -1, 1) * std::exp2(uniform(random, -30, 30));
        EXPECT_LT(residual(m, inverse(m)), 1e-8L);
    }
}

TEST(Matrix, InverseOfExtremeCameras) {
    // A near plane of 1e-6 and a far one of 1e9, then an eye 1e8 away: some entries are tiny, but nothing is singular.
    const double near_plane = 1e-6, far_plane = 1e9;
    const Mat4 proj{{{1, 0, 0, 0},
                     {0, 2, 0, 0},
                     {0, 0, -(far_plane + near_plane) / (far_plane - near_plane),
                      -2 * far_plane * near_plane / (far_plane - near_plane)},
                     {0, 0, -1, 0}}};
    EXPECT_LT(residual(proj, inverse(proj)), 1e-14L);
    const Mat4 reversed_infinite{{{1, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 0, 1e-6}, {0, 0, -1, 0}}};
    EXPECT_LT(residual(reversed_infinite, inverse(reversed_infinite)), 1e-15L);
}

TEST(Matrix, InverseRefusesSingularMatrices) {
    EXPECT_THROW(inverse(Mat4{}), Error);
    EXPECT_THROW(inverse({{{1, 2, 3, 4}, {2, 4, 6, 8}, {0, 0, 1, 0}, {0, 0, 0, 1}}}), Error);
    EXPECT_THROW(inverse({{{0.1, 0.2, 0.3, 1}, {0.4, 0.5, 0.6, 1}, {0.5, 0.7, 0.9, 2}, {0, 0, 0, 1}}}), Error);
    Mat4 m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    EXPECT_EQ(inverse(m), m);
    m[1][1] = std::nan("");
    EXPECT_THROW(inverse(m), Error);
    m[1][1] = INFINITY;
    EXPECT_THROW(inverse(m), Error);
}

}  // namespace
}  // namespace wrinkle
