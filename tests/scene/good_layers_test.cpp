#include <cmath>

#include "tests/scene/full_scene.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using GoodLayers = SceneFolder;

TEST_F(GoodLayers, MappedLayers) {
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
    EXPECT_EQ(second.mask.object, std::vector{3.0});
    EXPECT_EQ(second.mask.cryptomatte, std::vector<std::string>{"#1a2b3c4d"});
    EXPECT_EQ(second.mask.channel, "Dust.R");
    EXPECT_TRUE(second.mask.invert);
    ASSERT_TRUE(second.mask.texture);
    EXPECT_EQ(second.mask.texture->file, folder_ / "textures/wall.png");
    EXPECT_EQ(second.mask.texture->uv.scale, (std::array<double, 2>{4, 4}));
}

TEST_F(GoodLayers, OtherLayers) {
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
    EXPECT_EQ(scene.layers[7].mask.object, std::vector{2.0});
}

TEST_F(GoodLayers, MasksOfSeveralObjects) {
    const Scene scene = load_with(R"([[layer]]
kind = "noise"
mask = { object = [3, 4.0], cryptomatte = ["Rock*", "#1a2b3c4d"] }
[lighting]
leave = { cryptomatte = "Glass?", object = [7] }
)");
    EXPECT_EQ(scene.layers[0].mask.object, (std::vector{3.0, 4.0}));
    EXPECT_EQ(scene.layers[0].mask.cryptomatte, (std::vector<std::string>{"Rock*", "#1a2b3c4d"}));
    ASSERT_TRUE(scene.lighting.leave);
    EXPECT_EQ(scene.lighting.leave->cryptomatte, std::vector<std::string>{"Glass?"});
    EXPECT_EQ(scene.lighting.leave->object, std::vector{7.0});
}

TEST_F(GoodLayers, ObjectNormals) {
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

TEST_F(GoodLayers, DerivativeMaps) {
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
tangents = "passes"
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
    EXPECT_EQ(std::get<NormalMapLayer>(scene.layers.at(2).bump).tangents, TangentSource::planes);
}

TEST_F(GoodLayers, FractalsOfSimplexNoise) {
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

TEST_F(GoodLayers, WaysToCombineAndToCompare) {
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

TEST_F(GoodLayers, PlanesOfATriplanarProjection) {
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

}  // namespace
}  // namespace wrinkle
