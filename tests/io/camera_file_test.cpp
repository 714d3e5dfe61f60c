#include "io/camera_file.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

#include "io/header_camera.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

constexpr Size size{96, 54};
constexpr double aspect = 96.0 / 54.0;

Camera true_camera() { return Camera::look_at({1.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}, 0.6, aspect); }

/// Planar depth of a wavy surface at a pixel; the first columns are background.
double depth_at(int x, int y) { return x < 5 ? 1e10 : 6 + std::sin(0.2 * x) + std::cos(0.3 * y); }

enum class Space { world, camera };

/// Writes a frame seen by true_camera(): positions, depth, and the attributes of `header`.
void write_frame(const std::filesystem::path& file, const Metadata& header, std::vector<std::string> names,
                 bool ray = false, Space space = Space::world) {
    const auto camera = true_camera();
    const auto rays = *pinhole_rays(camera, size);
    auto spec = make_spec(96, 54, std::move(names));
    for (const auto& name : header.names()) {
        const auto matrix = *header.matrix(name);
        float values[16];
        for (std::size_t i = 0; i < 16; ++i) values[i] = static_cast<float>(matrix[i / 4][i % 4]);
        spec.attribute(name, OIIO::TypeMatrix44, values);
    }
    const auto pixel = [&](int c, int x, int y) -> float {
        const double z = depth_at(x, y);
        Vec3 d{}, p{};
        for (std::size_t i = 0; i < 3; ++i) d[i] = rays.d0[i] + (x + 0.5) * rays.dx[i] + (y + 0.5) * rays.dy[i];
        if (c >= 3) return static_cast<float>(ray ? z * std::hypot(d[0], d[1], d[2]) : z);
        if (z > 1e9) return 0;
        for (std::size_t i = 0; i < 3; ++i) p[i] = rays.eye[i] + z * d[i];
        if (space == Space::world) return static_cast<float>(p[static_cast<std::size_t>(c)]);
        const auto& row = camera.view[static_cast<std::size_t>(c)];
        const double view = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        return static_cast<float>(c == 2 ? -view : view);  // left-handed, z forward
    };
    write_image(file, {{spec, pixel}});
}

const std::vector<std::string> plain_names{"position.x", "position.y", "position.z", "depth"};
const std::vector<std::string> pbrt_names{"P.X", "P.Y", "P.Z", "w", "Ns.X"};

Mat4 transposed(const Mat4& m) {
    Mat4 t{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) t[i][j] = m[j][i];
    return t;
}

/// The matrix from world space to the EXR standard's camera space, which is left-handed. Acts on column vectors.
Mat4 world_to_camera() {
    return multiply({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}}}, true_camera().view);
}

/// The matrix from world space to normalised device coordinates with (0, 0) at the top left. Acts on column vectors.
Mat4 world_to_ndc() {
    const Mat4 window{{{0.5, 0, 0, 0.5}, {0, -0.5, 0, 0.5}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    return multiply(window, multiply(true_camera().proj, true_camera().view));
}

/// Expects that `camera` has the eye and the rays of true_camera().
void expect_same(const Camera& camera, double tolerance = 1e-4) {
    const auto found = pinhole_rays(camera, size), expected = pinhole_rays(true_camera(), size);
    ASSERT_TRUE(found);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(found->eye[i], expected->eye[i], tolerance);
        EXPECT_NEAR(found->d0[i], expected->d0[i], tolerance);
        EXPECT_NEAR(found->dx[i], expected->dx[i], tolerance);
        EXPECT_NEAR(found->dy[i], expected->dy[i], tolerance);
    }
}

CameraSource from_header() {
    CameraSource source;
    source.exr = true;
    return source;
}

TEST(ClipCamera, ComesBackFromItsProduct) {
    for (const double skew : {0.0, 0.1}) {
        auto camera = true_camera();
        camera.proj[0][2] = 0.3, camera.proj[1][2] = -0.2, camera.proj[1][0] = skew;
        const auto found = io::camera_of_clip(multiply(camera.proj, camera.view));
        ASSERT_TRUE(found);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                EXPECT_NEAR(found->view[i][j], camera.view[i][j], 1e-12);
                if (i != 2) { EXPECT_NEAR(found->proj[i][j], camera.proj[i][j], 1e-12); }
            }
    }
    Camera parallel = true_camera();
    parallel.proj = {{{0.2, 0, 0, 0.1}, {0, 0.3, 0, -0.1}, {0, 0, -0.1, 0}, {0, 0, 0, 1}}};
    const auto found = io::camera_of_clip(multiply(parallel.proj, parallel.view));
    ASSERT_TRUE(found);
    const Vec3 point{0.3, 0.2, 0.9};
    EXPECT_NEAR((*project(*found, size, point))[0], (*project(parallel, size, point))[0], 1e-9);
    EXPECT_NEAR((*project(*found, size, point))[1], (*project(parallel, size, point))[1], 1e-9);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found->view[2][j], parallel.view[2][j], 1e-12);
    EXPECT_FALSE(io::camera_of_clip(Mat4{}));
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

std::string json_matrix(const Mat4& m) {
    std::string text = "[";
    for (std::size_t i = 0; i < 4; ++i)
        text += fmt::format("{}[{}, {}, {}, {}]", i == 0 ? "" : ", ", m[i][0], m[i][1], m[i][2], m[i][3]);
    return text + "]";
}

TEST(CameraFile, Json) {
    TempFolder folder;
    write_frame(folder / "f.0012.exr", {}, plain_names);
    const GBufferReader reader(folder / "f.0012.exr");
    CameraSource source;
    source.file = folder / "f.####.json";
    const auto file = folder / "f.0012.json";
    const auto view = json_matrix(true_camera().view), proj = json_matrix(true_camera().proj);
    const auto complaint = [&](const std::string& text) {
        write_text(file, text);
        return error_of([&] { read_camera(source, reader, 12); });
    };
    expect_mentions(error_of([&] { read_camera(source, reader, 12); }), {"f.0012.json: there is no such file"});
    expect_mentions(complaint("{\"view\": [\n1,"), {"malformed", "line 2"});
    expect_mentions(complaint("[1, 2]"), {"not a camera file"});
    expect_mentions(complaint("{\"view\": " + view + "}"), {"\"proj\" is missing"});
    expect_mentions(complaint(R"({"view": [[1,2],[3,4]], "proj": 3})"), {"\"view\" is 2 rows", "4 rows of 4"});
    expect_mentions(complaint("{\"view\": " + view + R"(, "proj": [[1,0,0,0],[0,1,0,0],[0,0,"x",0],[0,0,1,0]]})"),
                    {"\"proj\" is no number in row 2, column 2"});
    expect_mentions(complaint("{\"view\": " + view + ",\n\"proj\": [[1e999,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,0]]}"),
                    {"f.0012.json", "line 2", "out of range", "1e999"});
    expect_mentions(
        complaint("{\"view\": " + json_matrix(transposed(true_camera().view)) + ", \"proj\": " + proj + "}"),
        {"view is transposed"});
    expect_mentions(complaint("{\"view\": [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]], \"proj\": " + proj + "}"),
                    {"view must be rigid"});
    expect_mentions(complaint("{\"view\": " + view + ", \"proj\": [[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,-1,0]]}"),
                    {"proj is singular"});
    expect_mentions(complaint(fmt::format(R"({{"width": 96, "height": 96, "view": {}, "proj": {}}})", view, proj)),
                    {"the camera is for 96x96 and the frame is 96x54"});
    write_text(file, fmt::format(R"({{"width": 192, "height": 108, "view": {}, "proj": {}}})", view, proj));
    expect_same(read_camera(source, reader, 12), 1e-12);
    Mat4 rounded = true_camera().view;
    rounded[3] = {1e-7, 0, -1e-7, 1.0000001};
    write_text(file, "{\"view\": " + json_matrix(rounded) + ", \"proj\": " + proj + "}");
    expect_same(read_camera(source, reader, 12), 1e-12);
    rounded[3] = {0, 0, 0, 1.01};
    expect_mentions(complaint("{\"view\": " + json_matrix(rounded) + ", \"proj\": " + proj + "}"),
                    {"view must have the last row [0, 0, 0, 1]; found [0, 0, 0, 1.01]"});
}

}  // namespace
}  // namespace wrinkle
