// Scenes made in code are checked by the rules for files, in their words.
#include <memory>

#include "tests/scene/scene_in_code.h"

namespace wrinkle {
namespace {

TEST_F(Check, ValuesThatAreNoneOfTheirType) {
    const auto noise = [&](auto set) {
        Layer wrong = layer<NoiseLayer>();
        set(std::get<NoiseLayer>(wrong.bump), wrong);
        return wrong;
    };
    const std::string rule = "is number 77, which is none of those allowed: ";
    expect_refused(noise([](auto& b, auto&) { b.type = static_cast<NoiseType>(77); }),
                   {"\"type\"", rule + "\"perlin\""});
    expect_refused(noise([](auto& b, auto&) { b.gradient = static_cast<NoiseGradient>(77); }), {"\"gradient\"", rule});
    expect_refused(noise([](auto& b, auto&) { b.fractal = static_cast<FractalKind>(77); }), {"\"fractal\"", rule});
    expect_refused(noise([](auto& b, auto&) { b.feature = static_cast<CellFeature>(77); }), {"\"feature\"", rule});
    expect_refused(noise([](auto&, auto& l) { l.blend = static_cast<Blend>(77); }),
                   {"\"blend\" in layer \"bump\"", rule + "\"add\", \"subtract\""});
    Layer map = layer<HeightMapLayer>();
    std::get<HeightMapLayer>(map.bump).texture.encoding = static_cast<Encoding>(77);
    expect_refused(map, {"\"encoding\"", rule});
    Layer heights = layer<NormalMapLayer>();
    std::get<NormalMapLayer>(heights.bump).texture.content = Content::height;
    expect_refused(heights, {"\"content\" in layer \"bump\"", "allowed: \"normal\""});
    Scene scene;
    scene.lighting.relight = static_cast<Relight>(77);
    EXPECT_NE(problems_of(scene).find("\"relight\" in [lighting] " + rule), std::string::npos) << problems_of(scene);
    scene.lighting = {.relight = Relight::lit, .lights = {{.kind = static_cast<LightKind>(77)}}};
    EXPECT_NE(problems_of(scene).find("\"kind\" in light 1 is number 77"), std::string::npos) << problems_of(scene);
}

TEST_F(Check, NamesAndTexts) {
    Layer odd = layer<NoiseLayer>();
    odd.name = "two\nlines";
    expect_refused(odd, {"\"name\" in layer 1 must be a text without control characters"});
    odd = layer(HeightChannelLayer{});
    expect_refused(odd, {"layer \"bump\" needs \"channel\""});
    odd = layer(HeightChannelLayer{"a\tb"});
    expect_refused(odd, {"\"channel\" in layer \"bump\" must be a text without control characters"});
    odd = layer<NoiseLayer>();
    odd.mask.cryptomatte = {""};
    expect_refused(odd, {"\"cryptomatte\" in mask of layer \"bump\" must be a text that is not empty"});

    Scene scene;
    scene.layers = {layer<NoiseLayer>(), layer<ConstantLayer>(), layer<NoiseLayer>()};
    scene.layers[1].name = "other";
    EXPECT_EQ(problems_of(scene), "the name \"bump\" of layer 3 is taken by layer 1; names are unique");
    for (Layer& each : scene.layers) each.name.clear();
    scene.layers.pop_back();
    EXPECT_EQ(problems_of(scene), "the name \"\" of layer 2 is taken by layer 1; names are unique");
    scene.layers.pop_back();
    EXPECT_EQ(problems_of(scene), "");
}

TEST_F(Check, FilesThatAreMissing) {
    Layer missing = layer<HeightMapLayer>();
    std::get<HeightMapLayer>(missing.bump).texture.file = folder_ / "none.png";
    expect_refused(missing, {"\"texture\" in layer \"bump\" is ", "none.png", "there is no file"});
    std::get<HeightMapLayer>(missing.bump).texture.file.clear();
    expect_refused(missing, {"layer \"bump\" needs \"texture\""});
    missing = layer<NoiseLayer>();
    missing.mask.texture = MaskTexture{};
    expect_refused(missing, {"mask of layer \"bump\" needs \"texture\""});
    expect_refused(layer(VolumeLayer{}), {"layer \"bump\" needs \"volume\""});
}

TEST_F(Check, DecalsByTheirCosines) {
    Layer decal = layer<DecalLayer>();
    std::get<DecalLayer>(decal.bump).angle_fade = {0.5, 1.5};
    expect_refused(decal, {"\"angle_fade\" in layer \"bump\"", "at least -1 and at most 1; found 1.5"});
    std::get<DecalLayer>(decal.bump).angle_fade = {0.5, 0.25};
    expect_refused(decal, {"\"angle_fade\" in layer \"bump\" must be cosines"});
}

TEST_F(Check, RowsOfTables) {
    const auto table = [&](const Projector& row) {
        DecalsLayer decals;
        decals.textures = {{.file = wall()}};
        decals.rows = std::make_shared<const std::vector<Projector>>(std::vector<Projector>{Projector{}, row});
        return layer(decals);
    };
    EXPECT_EQ(problems_of(table({})), "");
    EXPECT_EQ(problems_of(table({.half_size = {0, -1, 1}})), "") << "it touches nothing, and may";
    const std::string row = "\"rows\" in layer \"bump\" cannot be used:\nrow 1: ";
    expect_refused(table({.texture = 1}), {row, "\"texture\" is 1; the layer has 1 texture, counted from 0"});
    expect_refused(table({.center = {0, nan, 0}}), {row, "element 2 of \"center\""});
    expect_refused(table({.axis_x = {0, 0, 0}}), {row, "\"axis_x\", \"axis_y\" must be two axes"});
    expect_refused(table({.axis_y = {2, 0, 0}}), {row, "\"axis_x\", \"axis_y\" must be two axes"});
    expect_refused(table({.region = {0.5, 0, 0.5, 1}}), {row, "\"region\" must have s0 below s1"});
    expect_refused(table({.half_size = {1, 1, nan}}), {row, "element 3 of \"half_size\""});
    expect_refused(table({.scale = nan}), {row, "\"scale\""});
    expect_refused(table({.falloff = {0, 2, 0}}), {row, "element 2 of \"falloff\" must be a number from 0 to 1"});
    expect_refused(table({.angle_fade = {0.5, 2}}), {row, "\"angle_fade\" must be a cosine"});
    expect_refused(table({.repeat = {0, 1}}), {row, "element 1 of \"repeat\""});
    expect_refused(table({.opacity = 2}), {row, "\"opacity\" must be a number from 0 to 1"});
    expect_refused(table({.priority = nan}), {row, "\"priority\""});
    expect_refused(table({.object = nan}), {row, "\"object\""});
    expect_refused(table({.object = 1, .cryptomatte = "Rock"}), {row, "cannot both be given"});
    expect_refused(table({.cryptomatte = "a\nb"}), {row, "\"cryptomatte\" must be a text without control"});
    expect_refused(table({.shape = static_cast<ProjectorShape>(9)}), {row, "\"shape\" must be one of \"box\""});
    expect_refused(table({.wrap = static_cast<Wrap>(9)}), {row, "\"wrap\" must be one of"});
    expect_refused(table({.mode = static_cast<ProjectorMode>(9)}), {row, "\"mode\" must be one of"});
    DecalsLayer none;
    none.textures = {{}};
    expect_refused(layer(none), {"texture 0 of layer \"bump\" needs \"file\""});
}

TEST_F(Check, TellsEveryProblem) {
    Scene scene;
    scene.layers = {layer(NoiseLayer{.octaves = 0}), layer(ConstantLayer{{nan, 0, 0}})};
    scene.layers[1].name = "tilt";
    const std::string found = problems_of(scene);
    EXPECT_NE(found.find("\"octaves\" in layer \"bump\" must be a whole number from 1 to 16; found 0\n"),
              std::string::npos)
        << found;
    EXPECT_NE(found.find("\"gradient\" in layer \"tilt\""), std::string::npos) << found;
}

TEST(CheckOfFiles, AcceptsEveryScene) {
    std::size_t count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(WRINKLE_SOURCE_DIR) / "data/scenes"))
        if (entry.path().extension() == ".toml") {
            EXPECT_NO_THROW(check(load_scene(entry.path()))) << entry.path();
            ++count;
        }
    EXPECT_GT(count, 20u);
}

}  // namespace
}  // namespace wrinkle
