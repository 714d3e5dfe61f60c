#include "io/solve_camera.h"

#include <cmath>
#include <random>

#include "io/camera_file.h"
#include "io/camera_placing.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

constexpr Size size{320, 180};

/// Points of a room as a camera sees them: a wavy ground and a wall, rounded to floats.
std::vector<PositionSample> seen_by(const Camera& camera, bool flat = false, double far = 0) {
    const Mat4 back = inverse(multiply(camera.proj, camera.view));
    const auto at = [&](double x, double y, double z) {
        const double ndc[4] = {2 * x / size.width - 1, 1 - 2 * y / size.height, z, 1};
        double p[4]{};
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 4; ++k) p[i] += back[i][k] * ndc[k];
        return Vec3{p[0] / p[3], p[1] / p[3], p[2] / p[3]};
    };
    std::vector<PositionSample> samples;
    for (double y = 2.5; y < size.height; y += 6)
        for (double x = 1.5; x < size.width; x += 5) {
            const Vec3 a = at(x, y, -0.5), b = at(x, y, 0.5);
            Vec3 along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
            const double height = flat ? 0 : 0.4 * std::sin(0.05 * x) + 0.3 * std::cos(0.07 * y);
            double to = (height - a[2]) / along[2];
            const double wall = (6 - a[1]) / along[1];
            if (!flat && (!(to > 0) || wall < to)) to = wall;
            if (!(to > 0)) continue;
            PositionSample sample{x, y, {}, std::nan("")};
            for (std::size_t i = 0; i < 3; ++i) sample.position[i] = static_cast<float>(a[i] + to * along[i] + far);
            samples.push_back(sample);
        }
    return samples;
}

Camera a_camera(double fov = 0.8) { return Camera::look_at({1.5, -7.5, 3.6}, {0, 0, 0.8}, {0, 0, 1}, fov, 16.0 / 9); }

double residual(const Camera& camera, const std::vector<PositionSample>& samples) {
    return reprojection_residual(camera, size, samples).median;
}

TEST(SolveCamera, PinholesOfAnyFieldOfView) {
    for (const double fov : {0.1, 0.8, 1.9}) {
        const auto camera = a_camera(fov);
        const auto samples = seen_by(camera);
        const auto found = io::solve_camera(samples, size, 1);
        EXPECT_LT(residual(found, samples), 0.002) << fov;
        EXPECT_NEAR(found.proj[1][1] / camera.proj[1][1], 1, 1e-3) << fov;
        const auto eye = pinhole_rays(found, size)->eye;
        EXPECT_NEAR(eye[0], 1.5, 1e-2);
        EXPECT_NEAR(eye[1], -7.5, 1e-2);
    }
}

TEST(SolveCamera, ShiftPixelAspectAndRoll) {
    auto camera = Camera::look_at({1.5, -7.5, 3.6}, {0, 0, 0.8}, {0.3, 0, 1}, 0.8, 16.0 / 9);
    camera.proj[0][2] = 0.31, camera.proj[1][2] = -0.2;
    auto samples = seen_by(camera);
    EXPECT_LT(residual(io::solve_camera(samples, size, 1), samples), 0.002);
    camera.proj[0][0] /= 2;  // pixels twice as wide as tall, whether the header says so or not
    samples = seen_by(camera);
    EXPECT_LT(residual(io::solve_camera(samples, size, 2), samples), 0.002);
    EXPECT_LT(residual(io::solve_camera(samples, size, 1), samples), 0.002);
}

TEST(SolveCamera, AGroundAloneIsEnough) {
    const auto samples = seen_by(a_camera(), true);
    const auto found = io::solve_camera(samples, size, 1);
    EXPECT_LT(residual(found, samples), 0.002);
    EXPECT_NEAR(found.proj[1][1] / a_camera().proj[1][1], 1, 1e-3);
}

TEST(SolveCamera, ParallelProjections) {
    auto camera = a_camera();
    camera.proj = {{{0.1, 0, 0, 0.05}, {0, 0.1 * 16 / 9, 0, -0.02}, {0, 0, -0.01, 0}, {0, 0, 0, 1}}};
    auto samples = seen_by(camera);
    for (auto& sample : samples) {
        const auto& p = sample.position;
        const auto& back = camera.view[2];
        sample.depth = -(back[0] * p[0] + back[1] * p[1] + back[2] * p[2] + back[3]);
    }
    const auto found = io::solve_camera(samples, size, 1);
    EXPECT_LT(residual(found, samples), 0.002);
    EXPECT_EQ(found.proj[3][3], 1);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found.view[2][k], camera.view[2][k], 1e-4);
    EXPECT_NEAR(found.view[2][3], camera.view[2][3], 1e-3) << "the plane that depths start from";
    EXPECT_EQ(measure_depth_kind(found, samples), DepthKind::planar);
}

TEST(SolveCamera, FarFromTheOriginAndWithAThirdOfThePositionsOff) {
    auto samples = seen_by(a_camera(), false, 1000);
    EXPECT_LT(residual(io::solve_camera(samples, size, 1), samples), 0.05);  // floats there are 6e-5 apart
    samples = seen_by(a_camera());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-1, 1);
    for (std::size_t i = 0; i < samples.size(); i += 3) samples[i].position[i % 3] += off(random);
    EXPECT_LT(residual(io::solve_camera(samples, size, 1), samples), 0.01);
}

TEST(SolveCamera, WhatLeavesTheCameraOpenIsSaid) {
    const auto facing = Camera::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 0.8, 16.0 / 9);
    expect_mentions(error_of([&] { io::solve_camera(seen_by(facing, true), size, 1); }), {"field of view open"});
    std::vector<PositionSample> few(5);
    expect_mentions(error_of([&] { io::solve_camera(few, size, 1); }), {"only 5", "24 are needed"});
    std::vector<PositionSample> line(100), point(100);
    for (std::size_t i = 0; i < line.size(); ++i) line[i].position = {double(i), 2.0 * double(i), 0};
    expect_mentions(error_of([&] { io::solve_camera(line, size, 1); }), {"on one line"});
    expect_mentions(error_of([&] { io::solve_camera(point, size, 1); }), {"the same point"});
}

/// Writes a frame of positions and unit normals.
void write_positions(const std::filesystem::path& file, const std::vector<PositionSample>& samples) {
    std::vector<Vec3> pixels(std::size_t{size.width} * size.height);
    for (const auto& sample : samples)
        pixels[static_cast<std::size_t>(sample.y) * size.width + static_cast<std::size_t>(sample.x)] = sample.position;
    write_exr(file, size.width, size.height, {"P.X", "P.Y", "P.Z"}, [&](int c, int x, int y) {
        return static_cast<float>(pixels[static_cast<std::size_t>(y) * size.width + static_cast<std::size_t>(x)]
                                        [static_cast<std::size_t>(c)]);
    });
}

/// The camera's positions at every pixel of the rows that a frame's camera is solved from.
std::vector<PositionSample> all_pixels(const Camera& camera, double scatter_x = 0, double scatter_y = 0) {
    std::mt19937 random(3);
    std::normal_distribution<double> off;
    std::vector<PositionSample> samples;
    const auto rays = *pinhole_rays(camera, size);
    for (std::uint32_t y = 0; y < size.height; ++y)
        for (std::uint32_t x = 0; x < size.width; ++x) {
            PositionSample sample{x + 0.5, y + 0.5, {}, std::nan("")};
            const double px = x + 0.5 + scatter_x * off(random), py = y + 0.5 + scatter_y * off(random);
            const double z = 6 + std::sin(0.05 * px) + 2 * std::cos(0.04 * py);
            for (std::size_t i = 0; i < 3; ++i)
                sample.position[i] = rays.eye[i] + z * (rays.d0[i] + px * rays.dx[i] + py * rays.dy[i]);
            samples.push_back(sample);
        }
    return samples;
}

TEST(SolveCamera, ScenesWithoutACameraGetTheOneOfThePositions) {
    TempFolder folder;
    write_positions(folder / "f.exr", all_pixels(a_camera()));
    for (const bool asked : {false, true}) {
        CameraSource source;
        source.positions = asked;
        const auto found = read_frame_camera(source, GBufferReader(folder / "f.exr"));
        EXPECT_EQ(found.origin, "solved from the positions");
        EXPECT_LT(found.residual->median, 0.002);
    }
    write_exr(folder / "z.exr", 4, 4, {"Z"});
    CameraSource source;
    source.positions = true;
    expect_mentions(error_of([&] { read_camera(source, GBufferReader(folder / "z.exr")); }), {"no position pass", "Z"});
}

TEST(SolveCamera, DepthOfFieldAndMotionBlurAreToldByTheirPattern) {
    TempFolder folder;
    const auto misfit = [&](double x, double y) {
        write_positions(folder / "f.exr", all_pixels(a_camera(), x, y));
        return error_of([&] { read_camera({}, GBufferReader(folder / "f.exr")); });
    };
    expect_mentions(misfit(2, 2), {"to all sides", "depth of field"});
    expect_mentions(misfit(3, 0.3), {"along a line", "motion blur"});
}

TEST(WindowedCamera, OverscanIsMoreOfTheSamePicture) {
    const auto camera = a_camera();
    const FrameWindow window{-20, -10, size};
    const Size frame{size.width + 50, size.height + 25};
    const auto wide = io::windowed(camera, window, frame);
    for (const Vec3 point : {Vec3{0, 0, 0.8}, Vec3{2, 3, -1}, Vec3{-4, 1, 2}}) {
        const auto in_picture = *project(camera, size, point), in_frame = *project(wide, frame, point);
        EXPECT_NEAR(in_frame[0], in_picture[0] + 20, 1e-9);
        EXPECT_NEAR(in_frame[1], in_picture[1] + 10, 1e-9);
    }
    EXPECT_TRUE(pinhole_rays(wide, frame));
}

}  // namespace
}  // namespace wrinkle
