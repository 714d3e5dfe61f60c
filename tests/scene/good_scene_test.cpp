#include <cmath>
#include <numbers>

#include "tests/scene/full_scene.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using GoodScene = SceneFolder;

constexpr double degree = std::numbers::pi / 180;

void expect_near(const Vec3& found, const Vec3& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-15);
}

TEST_F(GoodScene, FrameAndCamera) {
    const Scene scene = load(full_scene);
    EXPECT_EQ(scene.file, folder_ / "courtyard.toml");
    EXPECT_EQ(scene.gbuffer.file, folder_ / "frame.exr");
    EXPECT_EQ(scene.gbuffer.roles,
              (std::map<std::string, std::string>{{"position", "ViewLayer.Position"}, {"uv", "ViewLayer.UV"}}));
    EXPECT_EQ(scene.gbuffer.geometry, Geometry::position);
    EXPECT_EQ(scene.gbuffer.depth, DepthKind::ray);
    EXPECT_TRUE(scene.camera.file.empty());
    EXPECT_FALSE(scene.camera.exr);
    EXPECT_FALSE(scene.camera.inline_camera);
    ASSERT_TRUE(scene.camera.look_at);
    EXPECT_EQ(scene.camera.look_at->eye, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene.camera.look_at->target, (Vec3{0, 0, 0.5}));
    EXPECT_EQ(scene.camera.look_at->up, (Vec3{0, 1, 0}));
    EXPECT_DOUBLE_EQ(scene.camera.look_at->fov_y, 45 * degree);
    EXPECT_EQ(scene.camera.max_residual, 2);
}

TEST_F(GoodScene, MappedLayers) {
    const Scene scene = load(full_scene);
    ASSERT_EQ(scene.layers.size(), 8u);
    const Layer& plaster = scene.layers[0];
    EXPECT_EQ(plaster.name, "plaster");
    EXPECT_EQ(plaster.location, (folder_ / "courtyard.toml:15").string());
    EXPECT_EQ(plaster.scale, -0.5);
    EXPECT_EQ(plaster.blend, Blend::subtract);
    EXPECT_FALSE(plaster.footprint);
    const auto& normal_map = std::get<NormalMapLayer>(plaster.bump);
    EXPECT_EQ(normal_map.texture.file, folder_ / "textures/wall.png");
    EXPECT_EQ(normal_map.texture.content, Content::normal);
    EXPECT_EQ(normal_map.texture.wrap, Wrap::clamp);
    EXPECT_TRUE(normal_map.texture.y_down);
    EXPECT_EQ(normal_map.uv.source, UvSource::aov);
    EXPECT_EQ(normal_map.uv.scale, (std::array<double, 2>{2, 2}));
    EXPECT_EQ(normal_map.uv.offset, (std::array<double, 2>{0.25, -1}));
    EXPECT_DOUBLE_EQ(normal_map.uv.rotation, 90 * degree);

    const Layer& second = scene.layers[1];
    EXPECT_EQ(second.name, "height_map 2");
    EXPECT_EQ(second.scale, 1);
    EXPECT_EQ(second.blend, Blend::add);
    EXPECT_TRUE(second.footprint);
    const auto& height_map = std::get<HeightMapLayer>(second.bump);
    EXPECT_EQ(height_map.texture.content, Content::height);
    EXPECT_EQ(height_map.texture.upscale, Upscale::plain);
    EXPECT_EQ(height_map.texture.wrap, Wrap::repeat);
    EXPECT_EQ(height_map.uv.source, UvSource::planar);
    EXPECT_EQ(height_map.uv.scale, (std::array<double, 2>{2, -3}));
    EXPECT_EQ(height_map.uv.axis_u, (Vec3{0, 1, 0}));
    EXPECT_EQ(height_map.uv.axis_v, (Vec3{0, 0, 2}));
    EXPECT_EQ(second.mask.object, 3);
    EXPECT_EQ(second.mask.cryptomatte, "#1a2b3c4d");
    EXPECT_EQ(second.mask.channel, "Dust.R");
    EXPECT_TRUE(second.mask.invert);
    ASSERT_TRUE(second.mask.texture);
    EXPECT_EQ(second.mask.texture->file, folder_ / "textures/wall.png");
    EXPECT_EQ(second.mask.texture->uv.scale, (std::array<double, 2>{4, 4}));
}

TEST_F(GoodScene, OtherLayers) {
    const Scene scene = load(full_scene);
    ASSERT_EQ(scene.layers.size(), 8u);
    const auto& triplanar = std::get<TriplanarLayer>(scene.layers[2].bump);
    EXPECT_EQ(triplanar.texture.content, Content::normal);
    EXPECT_TRUE(triplanar.texture.y_down);
    EXPECT_EQ(triplanar.tile, 0.75);
    EXPECT_EQ(triplanar.sharpness, 8);
    const auto& noise = std::get<NoiseLayer>(scene.layers[3].bump);
    EXPECT_EQ(scene.layers[3].name, "noise 4");
    EXPECT_EQ(noise.frequency, 3.5);
    EXPECT_EQ(noise.octaves, 16);
    EXPECT_EQ(noise.lacunarity, 2.25);
    EXPECT_EQ(noise.gain, 0.25);
    EXPECT_EQ(noise.type, NoiseType::worley);
    EXPECT_EQ(noise.feature, CellFeature::f2_f1);
    EXPECT_EQ(noise.gradient, NoiseGradient::central);
    EXPECT_EQ(noise.shape.remap, (std::array<double, 2>{-1, 2}));
    EXPECT_EQ(noise.shape.bias, 0.75);
    EXPECT_FALSE(noise.shape.power || noise.shape.smoothstep);
    EXPECT_TRUE(std::holds_alternative<ResolveLayer>(scene.layers[4].bump));
    const auto& decal = std::get<DecalLayer>(scene.layers[5].bump);
    EXPECT_EQ(decal.texture.wrap, Wrap::clamp);
    EXPECT_EQ(decal.center, (Vec3{1, 2, 3}));
    expect_near(decal.axis_x, {1, 0, 0});
    expect_near(decal.axis_y, {0, 0, 1});
    EXPECT_EQ(decal.half_size, (Vec3{1, 2, 0.5}));
    EXPECT_EQ(decal.falloff, 0);
    EXPECT_NEAR(decal.angle_fade[0], std::cos(75 * degree), 1e-15);
    EXPECT_NEAR(decal.angle_fade[1], 0.5, 1e-15);
    EXPECT_EQ(std::get<ConstantLayer>(scene.layers[6].bump).gradient, (Vec3{0.1, 0, -0.2}));
    const auto& parallax = std::get<ParallaxLayer>(scene.layers[7].bump);
    EXPECT_EQ(parallax.texture.file, folder_ / "textures/wall.png");
    EXPECT_EQ(parallax.texture.wrap, Wrap::clamp);
    EXPECT_EQ(parallax.uv.scale, (std::array<double, 2>{3, 3}));
    EXPECT_EQ(parallax.mode, ParallaxMode::march);
    EXPECT_EQ(parallax.steps, 64);
    EXPECT_EQ(parallax.refine, 5);
    EXPECT_EQ(parallax.level, 0.5);
    EXPECT_TRUE(parallax.curved);
    EXPECT_EQ(scene.layers[7].scale, 0.25);
    EXPECT_FALSE(scene.layers[7].footprint);
    EXPECT_EQ(scene.layers[7].mask.object, 2);
}

TEST_F(GoodScene, ObjectNormals) {
    const Scene scene = load_with(R"([[layer]]
kind = "object_normal"
texture = "textures/wall.png"
channels = "+x -z y"
object_to_world = [[0, 2, 0], [-1, 0, 0], [0, 0, 1]]
wrap = "clamp"
[[layer]]
kind = "object_normal"
texture = "textures/wall.png"
space = "world"
)");
    const auto& rope = std::get<ObjectNormalLayer>(scene.layers.at(0).bump);
    EXPECT_EQ(rope.texture.content, Content::object_normal);
    EXPECT_EQ(rope.texture.wrap, Wrap::clamp);
    EXPECT_EQ(rope.channels, (std::array<Vec3, 3>{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}}));
    EXPECT_EQ(rope.object_to_world[0], (Vec3{0, 2, 0}));
    EXPECT_EQ(rope.object_to_world[1], (Vec3{-1, 0, 0}));
    EXPECT_EQ(std::get<ObjectNormalLayer>(scene.layers.at(1).bump).object_to_world[2], (Vec3{0, 0, 1}));
}

TEST_F(GoodScene, DerivativeMaps) {
    const Scene scene = load_with(R"([[layer]]
kind = "derivative_map"
texture = "textures/wall.png"
y = "-"
encoding = "signed"
slopes = "texture"
bump_scale = "auto"
[[layer]]
kind = "derivative_map"
texture = "textures/wall.png"
[[layer]]
kind = "normal_map"
texture = "textures/wall.png"
frame = "tangents"
)");
    const auto& slopes = std::get<DerivativeMapLayer>(scene.layers.at(0).bump);
    EXPECT_EQ(slopes.texture.content, Content::slope);
    EXPECT_TRUE(slopes.texture.y_down && slopes.auto_scale);
    EXPECT_EQ(slopes.texture.encoding, Encoding::sign);
    EXPECT_EQ(slopes.texture.unit, SlopeUnit::texture);
    const auto& plain = std::get<DerivativeMapLayer>(scene.layers.at(1).bump);
    EXPECT_FALSE(plain.texture.y_down || plain.auto_scale);
    EXPECT_EQ(plain.texture.encoding, Encoding::automatic);
    EXPECT_EQ(plain.texture.unit, SlopeUnit::texel);
    EXPECT_EQ(std::get<NormalMapLayer>(scene.layers.at(2).bump).frame, TangentSource::planes);
}

TEST_F(GoodScene, FractalsOfSimplexNoise) {
    const Scene scene = load_with(
        "[[layer]]\nkind = \"noise\"\ntype = \"simplex\"\nperiod = [4, 0, 8]\nrotation = 90\noctaves = 3\n"
        "fractal = \"ridged\"\noffset = 0.9\nfeedback = 3\nshape = { power = 2.5 }\n");
    const auto& noise = std::get<NoiseLayer>(scene.layers.at(0).bump);
    EXPECT_EQ(noise.type, NoiseType::simplex);
    EXPECT_EQ(noise.period, (std::array<double, 3>{4, 0, 8}));
    EXPECT_NEAR(noise.rotation, 90 * degree, 1e-15);
    EXPECT_EQ(noise.fractal, FractalKind::ridged);
    EXPECT_EQ(noise.offset, 0.9);
    EXPECT_EQ(noise.feedback, 3);
    EXPECT_EQ(noise.shape.power, 2.5);
}

TEST_F(GoodScene, WaysToCombineAndToCompare) {
    const Scene scene = load_with(R"([[layer]]
kind = "normal_map"
texture = "textures/wall.png"
combine = "rnm"
[[layer]]
kind = "height_channel"
channel = "Height.V"
scale = 0.5
[[layer]]
kind = "noise"
project = false
[[layer]]
kind = "triplanar"
texture = "textures/wall.png"
content = "normal"
origin = "upper_left"
handedness = "right"
mode = "geiss"
transform = { translate = [1, 2, 3], rotate = [90, 0, -180], scale = 2 }
[[layer]]
kind = "triplanar"
texture = "textures/wall.png"
transform = { scale = [1, -1, 2] }
)");
    ASSERT_EQ(scene.layers.size(), 5u);
    EXPECT_EQ(std::get<NormalMapLayer>(scene.layers[0].bump).combine, Combine::rnm);
    EXPECT_EQ(std::get<HeightChannelLayer>(scene.layers[1].bump).channel, "Height.V");
    EXPECT_EQ(scene.layers[1].scale, 0.5);
    EXPECT_FALSE(scene.layers[2].project);
    const auto& geiss = std::get<TriplanarLayer>(scene.layers[3].bump);
    EXPECT_EQ(geiss.origin, TextureOrigin::upper_left);
    EXPECT_EQ(geiss.handedness, Handedness::right);
    EXPECT_EQ(geiss.mode, TriplanarMode::geiss);
    EXPECT_FALSE(scene.layers[3].project);
    EXPECT_EQ(geiss.transform.translate, (Vec3{1, 2, 3}));
    expect_near(geiss.transform.rotate, {90 * degree, 0, -180 * degree});
    EXPECT_EQ(geiss.transform.scale, (Vec3{2, 2, 2}));
    EXPECT_TRUE(scene.layers[4].project);
    EXPECT_EQ(std::get<TriplanarLayer>(scene.layers[4].bump).transform.scale, (Vec3{1, -1, 2}));
}

TEST_F(GoodScene, PlanesOfATriplanarProjection) {
    const Scene scene = load_with(R"([[layer]]
kind = "triplanar"
texture = "textures/wall.png"
content = "object_normal"
[layer.planes]
y = { texture = "textures/wall.png", content = "slope", y = "-", slopes = "texture", encoding = "unit", scale = 2 }
z = { noise = { type = "worley", feature = "f2-f1", frequency = 7, shape = { power = 2 } } }
)");
    const auto& layer = std::get<TriplanarLayer>(scene.layers[0].bump);
    EXPECT_EQ(layer.texture.content, Content::object_normal);
    EXPECT_FALSE(layer.planes[0]);
    const auto& slopes = std::get<TextureUse>(layer.planes[1]->content);
    EXPECT_EQ(slopes.content, Content::slope);
    EXPECT_TRUE(slopes.y_down);
    EXPECT_EQ(slopes.unit, SlopeUnit::texture);
    EXPECT_EQ(slopes.encoding, Encoding::unit);
    EXPECT_EQ(layer.planes[1]->scale, 2);
    const auto& cells = std::get<NoiseLayer>(layer.planes[2]->content);
    EXPECT_EQ(cells.feature, CellFeature::f2_f1);
    EXPECT_EQ(cells.frequency, 7);
    EXPECT_EQ(cells.shape.power, 2);
    EXPECT_EQ(layer.planes[2]->scale, 1);
}

TEST_F(GoodScene, LightingAndOutput) {
    const Scene scene = load(full_scene);
    const Lighting& lighting = scene.lighting;
    EXPECT_EQ(lighting.relight, Relight::ratio);
    EXPECT_EQ(lighting.ambient, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(lighting.albedo, (Vec3{0.4, 0.5, 0.6}));
    EXPECT_EQ(lighting.roughness, 0.25);
    EXPECT_EQ(lighting.f0, 0.05);
    EXPECT_EQ(lighting.max_ratio, 8);
    EXPECT_EQ(lighting.exposure, -1.5);
    ASSERT_EQ(lighting.lights.size(), 3u);
    EXPECT_EQ(lighting.lights[0].kind, LightKind::sun);
    EXPECT_EQ(lighting.lights[0].color, (Vec3{1, 0.5, 0.25}));
    EXPECT_EQ(lighting.lights[0].intensity, 3);
    expect_near(lighting.lights[0].direction, {0, 0.6, -0.8});
    EXPECT_EQ(lighting.lights[1].kind, LightKind::spot);
    EXPECT_DOUBLE_EQ(lighting.lights[1].inner_angle, 10 * degree);
    EXPECT_DOUBLE_EQ(lighting.lights[1].outer_angle, 20 * degree);
    EXPECT_EQ(lighting.lights[2].kind, LightKind::point);
    EXPECT_EQ(lighting.lights[2].position, (Vec3{4, 5, 6}));
    const Output& output = scene.output;
    EXPECT_TRUE(output.surface_gradient && output.dp_dx && output.dp_dy && output.marked);
    EXPECT_TRUE(output.passthrough && output.half && output.condition);
    EXPECT_EQ(scene.budget.max_error, 0.05);
    EXPECT_EQ(scene.budget.sample, 1000);
    EXPECT_EQ(scene.budget.seed, 7);
    EXPECT_FALSE(output.png);
}

TEST_F(GoodScene, DefaultsAreThoseOfTheStructs) {
    const Scene scene = load_with("[[layer]]\nkind = \"noise\"\n");
    EXPECT_TRUE(scene.camera.exr);
    EXPECT_EQ(scene.camera.max_residual, 0.5);
    EXPECT_EQ(scene.lighting.relight, Relight::off);
    EXPECT_TRUE(scene.output.png);
    EXPECT_EQ(std::get<NoiseLayer>(scene.layers.at(0).bump).octaves, 1);
    EXPECT_TRUE(load("layer = []\n" + frame_).layers.empty());
}

TEST_F(GoodScene, InlineMatricesAndCameraFiles) {
    const std::string gbuffer = "[gbuffer]\nfile = \"frame.exr\"\n[camera]\n";
    const Scene inline_matrices = load(gbuffer + R"(
view = [[1, 0, 0, -1e6], [0, 0, 1, 2], [0, -1, 0, 3.5], [0, 0, 0, 1]]
proj = [[1.5, 0, 0.1, 0], [0, 2, 0, 0], [0, 0, -1, -0.02], [0, 0, -1, 0]]
)");
    ASSERT_TRUE(inline_matrices.camera.inline_camera);
    EXPECT_EQ(inline_matrices.camera.inline_camera->view[0], (std::array<double, 4>{1, 0, 0, -1e6}));
    EXPECT_EQ(inline_matrices.camera.inline_camera->proj[0], (std::array<double, 4>{1.5, 0, 0.1, 0}));
    EXPECT_EQ(load(gbuffer + "file = \"camera.json\"\n").camera.file, folder_ / "camera.json");
    EXPECT_EQ(load(gbuffer + "file = \"textures/camera.####.json\"\n").camera.file,
              folder_ / "textures/camera.####.json");
    EXPECT_EQ(load("camera.from = \"exr\"\ngbuffer.file = \"frame_%04d.exr\"\n").gbuffer.file,
              folder_ / "frame_%04d.exr");
}

TEST_F(GoodScene, RolesByPlane) {
    const Scene scene = load_with("[gbuffer.roles]\nuv.u = \"s\"\n\"uv.v\" = \"t\"\nobject = \"none\"\n");
    EXPECT_EQ(scene.gbuffer.roles,
              (std::map<std::string, std::string>{{"uv.u", "s"}, {"uv.v", "t"}, {"object", "none"}}));
}

TEST_F(GoodScene, TablesInLineAndAbsolutePaths) {
    const Scene scene =
        load("gbuffer = { file = \"" + (folder_ / "frame.exr").string() +
             "\" }\r\ncamera = { from = \"exr\" }\r\nlayer = [\r\n  { kind = \"resolve\" },\r\n  { kind "
             "= \"noise\" },\r\n]\r\n");
    EXPECT_EQ(scene.gbuffer.file, folder_ / "frame.exr");
    ASSERT_EQ(scene.layers.size(), 2u);
    EXPECT_EQ(scene.layers[1].location, (folder_ / "courtyard.toml:5").string());
    EXPECT_EQ(scene.layers[1].name, "noise 2");
}

}  // namespace
}  // namespace wrinkle
