#include "io/camera_file.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

#include "tests/io/camera_frames.h"

namespace wrinkle {
namespace {

using namespace test;

CameraSource from_header() {
    CameraSource source;
    source.exr = true;
    return source;
}

TEST(CameraFile, HeaderOfTheStandard) {
    TempFolder folder;
    Metadata header;
    header.set("worldToCamera", transposed(world_to_camera()));
    header.set("worldToNDC", transposed(world_to_ndc()));
    write_frame(folder / "f.exr", header, plain_names);
    const auto found = read_frame_camera(from_header(), GBufferReader(folder / "f.exr"));
    EXPECT_EQ(found.origin, "header: worldToNDC, row vectors, (0,0) top left");
    ASSERT_TRUE(found.residual);
    EXPECT_LT(found.residual->p99, 0.01);
    EXPECT_GT(found.residual->count, 1000u);
    EXPECT_EQ(found.depth, DepthKind::planar);
    expect_same(found.camera);
}

TEST(CameraFile, HeaderWithoutPositionsToCheckWith) {
    TempFolder folder;
    Metadata header;
    header.set("worldToCamera", transposed(world_to_camera()));
    header.set("worldToNDC", transposed(world_to_ndc()));
    write_frame(folder / "f.exr", header, {"a.x", "a.y", "a.z", "depth"});
    const auto found = read_frame_camera(from_header(), GBufferReader(folder / "f.exr"));
    EXPECT_FALSE(found.residual);
    EXPECT_FALSE(found.depth);
    expect_same(found.camera);
}

TEST(CameraFile, HeaderOfPbrtIsTransposedAndYUp) {
    TempFolder folder;
    // Coordinates in [0,1] with y up, where the width of the screen window is the aspect.
    const Mat4 window{{{0.5 * aspect, 0, 0, 0.5}, {0, 0.5, 0, 0.5}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    Metadata header;
    header.set("worldToCamera", world_to_camera());
    header.set("worldToNDC", multiply(window, multiply(true_camera().proj, true_camera().view)));
    write_frame(folder / "world.exr", header, pbrt_names);
    const GBufferReader reader(folder / "world.exr");
    EXPECT_EQ(reader.roles().writer, Writer::pbrt);
    const auto found = read_frame_camera(from_header(), reader);
    EXPECT_EQ(found.origin, "header: worldToNDC, transposed, (0,0) bottom left, screen window");
    EXPECT_LT(found.residual->p99, 0.01);
    expect_same(found.camera);

    write_frame(folder / "camera.exr", header, pbrt_names, false, Space::camera);
    const auto in_camera_space = read_frame_camera(from_header(), GBufferReader(folder / "camera.exr"));
    expect_mentions(in_camera_space.origin, {"positions in camera space"});
    EXPECT_LT(in_camera_space.residual->p99, 0.01);
}

TEST(CameraFile, HeaderOfVRayIsCameraToWorld) {
    TempFolder folder;
    auto spec = make_spec(96, 54, {"bump_normals.X", "bump_normals.Y", "bump_normals.Z"});
    const auto matrix = transposed(inverse(true_camera().view));
    float values[16];
    for (std::size_t i = 0; i < 16; ++i) values[i] = static_cast<float>(matrix[i / 4][i % 4]);
    spec.attribute("cameraTransform", OIIO::TypeMatrix44, values);
    write_image(folder / "no_fov.exr", {{spec}});
    expect_mentions(error_of([&] { read_camera(from_header(), GBufferReader(folder / "no_fov.exr")); }),
                    {"no_fov.exr: the header has no camera", "field of view"});
    spec.attribute("cameraFov", static_cast<float>(2 * std::atan(std::tan(0.3) * aspect) * 180 / 3.14159265358979));
    write_image(folder / "vray.exr", {{spec}});
    expect_same(read_camera(from_header(), GBufferReader(folder / "vray.exr")));
}

TEST(CameraFile, WhatIsWrongWithTheHeaderIsTold) {
    TempFolder folder;
    Mat4 broken = transposed(world_to_ndc());
    const auto complaint = [&] {
        Metadata header;
        header.set("worldToCamera", transposed(world_to_camera()));
        header.set("worldToNDC", broken);
        write_frame(folder / "f.exr", header, plain_names);
        return error_of([&] { read_camera(from_header(), GBufferReader(folder / "f.exr")); });
    };
    broken[1][0] = std::numeric_limits<double>::quiet_NaN();
    expect_mentions(complaint(), {"f.exr", "worldToNDC holds numbers that are not finite"});
    broken = Mat4{};
    expect_mentions(complaint(), {"worldToNDC is no projection"});
}

TEST(CameraFile, RayDistanceIsToldFromPlanarDepth) {
    TempFolder folder;
    write_frame(folder / "ray.exr", {}, plain_names, true);
    CameraSource source;
    source.inline_camera = true_camera();
    EXPECT_EQ(read_frame_camera(source, GBufferReader(folder / "ray.exr")).depth, DepthKind::ray);
}

TEST(CameraFile, LookAtTakesTheFramesAspect) {
    TempFolder folder;
    write_frame(folder / "f.exr", {}, plain_names);
    CameraSource source;
    source.look_at = CameraSource::LookAt{{1.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}, 0.6};
    expect_same(read_camera(source, GBufferReader(folder / "f.exr")), 1e-12);
}

TEST(CameraFile, ACameraThatDoesNotFitIsRefused) {
    TempFolder folder;
    write_frame(folder / "f.exr", {}, plain_names);
    CameraSource source;
    source.look_at = CameraSource::LookAt{{1.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}, 0.7};
    expect_mentions(error_of([&] { read_camera(source, GBufferReader(folder / "f.exr")); }),
                    {"does not fit", "f.exr", "pixels away", "max_residual = 0.5"});
    source.max_residual = 20;
    EXPECT_NO_THROW(read_camera(source, GBufferReader(folder / "f.exr")));
    expect_mentions(error_of([&] { read_camera(from_header(), GBufferReader(folder / "f.exr")); }),
                    {"the header has no camera: neither worldToNDC"});
}

TEST(CameraFile, AWrongAxisIsToldAsSuch) {
    TempFolder folder;
    write_frame(folder / "f.exr", {}, plain_names);
    CameraSource source;
    source.look_at = CameraSource::LookAt{{1.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}, 0, 0.6};
    expect_mentions(error_of([&] { read_camera(source, GBufferReader(folder / "f.exr")); }),
                    {"fov_y fits", "picture's other side"});
    source.look_at = CameraSource::LookAt{{2.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}, 0.6};
    expect_mentions(error_of([&] { read_camera(source, GBufferReader(folder / "f.exr")); }),
                    {"from = \"positions\" solves fits within"});
}

TEST(CameraFile, FieldsOfViewAndLensesAreTheSame) {
    TempFolder folder;
    write_frame(folder / "f.exr", {}, plain_names);
    const GBufferReader reader(folder / "f.exr");
    CameraSource source;
    const CameraSource::LookAt place{{1.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}};
    source.look_at = place;
    source.look_at->fov_x = 2 * std::atan(std::tan(0.3) * aspect);
    expect_same(read_camera(source, reader), 1e-12);
    const double tall = std::tan(0.3), wide = tall * aspect;
    for (const auto& [fit, sensor] : {std::pair{Lens::Fit::automatic, std::array{36.0, 5.0}},
                                      {Lens::Fit::horizontal, {36.0, 5.0}},
                                      {Lens::Fit::vertical, {5.0, 24.0}}}) {
        source.look_at = place;
        const bool vertical = fit == Lens::Fit::vertical;
        source.look_at->lens = Lens{(vertical ? 24 / tall : 36 / wide) / 2, sensor, fit};
        expect_same(read_camera(source, reader), 1e-12);
    }
    source.look_at->shift = {0.25, -0.1};
    source.max_residual = 1e9;
    const auto shifted = read_camera(source, reader);  // Blender's: shares of the longer side
    EXPECT_NEAR((*project(shifted, size, {0, 0, 0.8}))[0], 48 - 0.25 * 96, 1e-9);
    EXPECT_NEAR((*project(shifted, size, {0, 0, 0.8}))[1], 27 - 0.1 * 96, 1e-9);
}

}  // namespace
}  // namespace wrinkle
