// The examples in the comments of the public headers, line by line; header_lines.cmake compares the two.
#include <gtest/gtest.h>

#include <iostream>
#include <vector>

#include "wrinkle/camera.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/device.h"
#include "wrinkle/error.h"
#include "wrinkle/frame_source.h"
#include "wrinkle/functions.h"
#include "wrinkle/gbuffer.h"
#include "wrinkle/layers.h"
#include "wrinkle/lighting.h"
#include "wrinkle/limits.h"
#include "wrinkle/noise_layer.h"
#include "wrinkle/passes.h"
#include "wrinkle/plane_format.h"
#include "wrinkle/resources.h"
#include "wrinkle/scene.h"
#include "wrinkle/textures.h"

TEST(HeaderExample, Error) {
    testing::internal::CaptureStderr();
    try {
        wrinkle::load_scene("missing.toml");
    } catch (const wrinkle::Error& error) { std::cerr << error.what() << '\n'; }
    EXPECT_NE(testing::internal::GetCapturedStderr().find("missing.toml"), std::string::npos);
}

TEST(HeaderExample, Limits) {
    wrinkle::set_limits({.memory = std::uint64_t{8} << 30, .sandbox = {}, .volume_reader = {}});
    EXPECT_THROW(wrinkle::set_limits({.memory = 0, .sandbox = "/nowhere", .volume_reader = {}}), wrinkle::Error);
}

TEST(HeaderExample, Camera) {
    const auto camera = wrinkle::Camera::look_at({0, -5, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 16.0 / 9);
    const auto pixel = wrinkle::project(camera, {1920, 1080}, {0, 0, 0});  // the middle: 960, 540
    ASSERT_TRUE(pixel.has_value());
    EXPECT_NEAR((*pixel)[0], 960, 1e-9);
    EXPECT_NEAR((*pixel)[1], 540, 1e-9);
}

TEST(HeaderExample, GBuffer) {
    for (const wrinkle::Role& role : wrinkle::gbuffer_roles())
        std::cout << role.name << " has " << role.planes.size() << " planes\n";
    const std::vector<float> marked{3};
    const bool background = (static_cast<int>(marked[0]) & wrinkle::Marked::invalid) != 0;
    EXPECT_TRUE(background);
}

TEST(HeaderExample, PlaneFormat) {
    const wrinkle::Size size{8, 4};
    const auto camera = wrinkle::Camera::look_at({0, -5, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 2);
    wrinkle::Frame frame{size, camera, {"depth", "normal.x", "normal.y", "normal.z", "roughness"}};
    using enum wrinkle::PlaneEncoding;
    frame.formats = wrinkle::interleaved("normals", octahedral16, {"normal.x", "normal.y", "normal.z"});
    frame.formats["roughness"] = {.encoding = unorm8};
    frame.formats["depth"] = {.encoding = half};
    const auto pass = wrinkle::screen_derivatives(wrinkle::Device::open(), frame);
    EXPECT_EQ(pass.inputs(), (std::vector<std::string>{"depth", "normals"}));
    const auto rgba = wrinkle::interleaved("gbuffer0", wrinkle::PlaneEncoding::unorm8,
                                           {"albedo.r", "albedo.g", "albedo.b", "roughness"});
    EXPECT_EQ(rgba.at("roughness").offset, 3u);
}

TEST(HeaderExample, Device) {
    for (const wrinkle::DeviceInfo& info : wrinkle::list_devices()) std::cout << info.name << '\n';
    const auto device = wrinkle::Device::open();                             // a GPU, else a CPU
    const auto same = wrinkle::Device::adopt(device.context, device.queue);  // or any context and queue of yours
    EXPECT_EQ(same.info.name, device.info.name);
}

TEST(HeaderExample, Functions) {
    const wrinkle::Function& resolve = wrinkle::function("resolve");
    std::cout << resolve.summary << " (" << resolve.source << ")\n";
    const std::vector<float> zero(100), one(100, 1), slope(100, 0.75f);
    std::vector<float> x(100), z(100);
    wrinkle::Columns in{{"n.x", zero}, {"n.y", zero}, {"n.z", one}, {"g.y", zero}, {"g.z", zero}};
    in["g.x"] = slope;
    wrinkle::evaluate_function(wrinkle::Device::open(), resolve, in, {{"normal.x", x}, {"normal.z", z}});
    EXPECT_NEAR(x[99], -0.6, 1e-6);
    EXPECT_NEAR(z[0], 0.8, 1e-6);
}

TEST(HeaderExample, Textures) {
    const wrinkle::TextureUse bricks{.file = "bricks.png", .content = wrinkle::Content::normal, .y_down = true};
    const wrinkle::UvMapping four_times{.scale = {4, 4}};
    const wrinkle::NormalMapLayer wall{.texture = bricks, .uv = four_times};
    EXPECT_TRUE(wall.texture.y_down && wall.uv.scale[1] == 4);
}

TEST(HeaderExample, Resources) {
    const auto camera = wrinkle::Camera::look_at({0, -5, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 16.0 / 9);
    const std::vector<double> numbers = wrinkle::camera_numbers(camera, {1920, 1080});
    const std::vector<float> narrowed(numbers.begin(), numbers.end());
    const std::vector<float> heights(64 * 32, 0.5f);
    const wrinkle::ImageSource flat{.memory = wrinkle::ImageInMemory{64, 32, 1, heights}};
    const wrinkle::VolumeSource fog{.file = "fog.vdb", .grid = "density"};
    const std::vector<wrinkle::TextureSource> sources{flat};  // or {flat, fog}
    const wrinkle::TexelData data = wrinkle::texel_data(sources);
    const wrinkle::Projector seal{.center = {0, 0, 0.1}, .half_size = {0.5, 0.5, 0.2}, .scale = 0.01};
    const auto row = wrinkle::projector_numbers(seal, {.texture = 0, .height = true}, wrinkle::eye_of(camera));
    EXPECT_EQ(narrowed.at(0), 1920);
    EXPECT_EQ(data.textures.at(1), 32u);
    EXPECT_EQ(row.at(1), 5);  // the centre, relative to the eye
    EXPECT_EQ(fog.filter, wrinkle::VolumeFilter::linear);
}

TEST(HeaderExample, Decals) {
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(testing::TempDir());
    const std::vector<wrinkle::Projector> rows(3, {.center = {0, 0, 1}, .half_size = {0.2, 0.2, 0.5}});
    wrinkle::save_decals("three.csv", rows);
    wrinkle::DecalsLayer seals;
    seals.textures = {{.file = "seal.png", .wrap = wrinkle::Wrap::clamp}};
    seals.rows = std::make_shared<const std::vector<wrinkle::Projector>>(wrinkle::load_decals("three.csv", 1));
    EXPECT_EQ(seals.rows->at(2).half_size, rows[2].half_size);
    std::filesystem::remove("three.csv");
    std::filesystem::current_path(before);
}

TEST(HeaderExample, FrameSourceAndLighting) {
    wrinkle::Scene scene;
    scene.gbuffer.file = "shot.####.exr";
    scene.gbuffer.roles["uv"] = "UVMap";
    scene.camera.look_at = {.eye = {0, -5, 2}, .target = {0, 0, 0}, .fov_y = 0.9};
    EXPECT_EQ(scene.camera.look_at->up, (wrinkle::Vec3{0, 0, 1}));
    scene.lighting.relight = wrinkle::Relight::lit;
    scene.lighting.lights = {{.kind = wrinkle::LightKind::sun, .direction = {0.6, 0, -0.8}}};
    EXPECT_EQ(scene.lighting.lights.at(0).intensity, 1);
}

TEST(HeaderExample, SceneAndPasses) {
    wrinkle::Layer grain;
    grain.name = "grain";
    grain.bump = wrinkle::NoiseLayer{.frequency = 20, .octaves = 4};
    grain.scale = 0.002;      // metres
    grain.mask.object = {7};  // only on this object
    wrinkle::Scene scene;
    scene.layers = {grain};
    scene.output.half = true;  // 16-bit files

    const wrinkle::Size size{40, 30};
    const auto camera = wrinkle::Camera::look_at({0, -5, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 4.0 / 3);
    const std::size_t pixels = 40 * 30;
    const std::vector<float> depth(pixels, 5), nx(pixels), ny(pixels), nz(pixels, 1);
    std::vector<float> out_x(pixels), out_y(pixels), out_z(pixels);
    scene.layers[0].mask = {};  // no object plane here
    const wrinkle::Frame frame{size, camera, {"depth", "normal.x", "normal.y", "normal.z"}};
    wrinkle::PassOptions careful;
    careful.precision = {wrinkle::Precision::exact, {wrinkle::Precision::exact}};  // of one layer
    EXPECT_EQ(wrinkle::evaluate(wrinkle::Device::open(), scene, frame, careful).inputs().size(), 4u);
    auto pass = wrinkle::evaluate(wrinkle::Device::open(), scene, frame);
    pass.run({{"depth", depth}, {"normal.x", nx}, {"normal.y", ny}, {"normal.z", nz}},
             {{"normal.x", out_x}, {"normal.y", out_y}, {"normal.z", out_z}});
    EXPECT_NE(out_x, nx);
}
