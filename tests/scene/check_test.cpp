// Scenes made in code are checked by the rules for files, in their words.
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <regex>

#include "tests/scene/scene_folder.h"
#include "wrinkle/layers.h"

namespace wrinkle {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Check : public SceneFolder {
protected:
    std::filesystem::path wall() const { return folder_ / "textures/wall.png"; }

    template <class Bump>
    Layer layer(Bump bump = {}) const {
        Layer layer;
        layer.name = "bump";
        if constexpr (requires { bump.texture; }) bump.texture.file = wall();
        layer.bump = std::move(bump);
        return layer;
    }

    static std::string problems_of(const Scene& scene) {
        try {
            check(scene);
        } catch (const Error& error) { return error.what(); }
        return {};
    }

    static std::string problems_of(const Layer& layer) {
        Scene scene;
        scene.layers = {layer};
        return problems_of(scene);
    }

    static void expect_refused(const Layer& layer, const std::vector<std::string>& parts) {
        const std::string found = problems_of(layer);
        for (const std::string& part : parts) EXPECT_NE(found.find(part), std::string::npos) << part << "\n" << found;
    }

    /// What a file with this text is refused for, as if it were of no file.
    std::string of_file(const std::string& text) const {
        std::string all;
        for (const std::string& problem : problems(frame_ + text)) {
            const std::string bare = std::regex_replace(problem, std::regex("^courtyard.toml:[0-9]+: "), "");
            all +=
                (all.empty() ? "" : "\n") + std::regex_replace(bare, std::regex("\\[\\[(layer|light)\\]\\] "), "$1 ");
        }
        return all;
    }

    /// A slip: as a line of a file, and in code.
    template <class Bump>
    struct Slip {
        const char* line;
        std::function<void(Bump&, Layer&)> make;
    };

    /// Each slip is refused, in code as in a file of a layer of that kind and these keys.
    template <class Bump>
    void expect_same(const std::string& keys, const Bump& sound, const std::vector<Slip<Bump>>& slips) const {
        EXPECT_EQ(problems_of(layer(sound)), "");
        for (const Slip<Bump>& slip : slips) {
            Layer wrong = layer(sound);
            slip.make(std::get<Bump>(wrong.bump), wrong);
            const std::string text = "[[layer]]\nname = \"bump\"\nkind = \"" + std::string(Bump::kind) + "\"\n" +
                                     (keys.empty() ? "" : keys + "\n") + slip.line + "\n";
            const std::string of_code = problems_of(wrong);
            EXPECT_NE(of_code, "") << slip.line;
            EXPECT_EQ(of_code, of_file(text)) << slip.line;
        }
    }

    const std::string texture_ = "texture = \"textures/wall.png\"";
};

TEST_F(Check, NumbersOfEveryLayer) {
    expect_same<NoiseLayer>(
        "", {},
        {{"scale = nan", [](NoiseLayer&, Layer& l) { l.scale = nan; }},
         {"scale = 1e39", [](NoiseLayer&, Layer& l) { l.scale = 1e39; }},
         {"mask = { object = inf }",
          [](NoiseLayer&, Layer& l) { l.mask.object = std::numeric_limits<double>::infinity(); }},
         {"mask = { cryptomatte = \"#12\" }", [](NoiseLayer&, Layer& l) { l.mask.cryptomatte = "#12"; }},
         {"mask = { invert = true }", [](NoiseLayer&, Layer& l) { l.mask.invert = true; }},
         {"mask = { texture = \"textures/wall.png\", uv = { scale = [0.0, 1.0] } }", [this](NoiseLayer&, Layer& l) {
              l.mask.texture = MaskTexture{wall(), {.scale = {0, 1}}};
          }}});
}

TEST_F(Check, NumbersOfNoise) {
    NoiseLayer simplex;
    simplex.type = NoiseType::simplex;
    expect_same<NoiseLayer>(
        "type = \"simplex\"", simplex,
        {{"frequency = 0.0", [](NoiseLayer& b, Layer&) { b.frequency = 0; }},
         {"frequency = nan", [](NoiseLayer& b, Layer&) { b.frequency = nan; }},
         {"octaves = 0", [](NoiseLayer& b, Layer&) { b.octaves = 0; }},
         {"octaves = 1000000", [](NoiseLayer& b, Layer&) { b.octaves = 1000000; }},
         {"lacunarity = 17.0", [](NoiseLayer& b, Layer&) { b.lacunarity = 17; }},
         {"gain = -1.0", [](NoiseLayer& b, Layer&) { b.gain = -1; }},
         {"rotation = nan", [](NoiseLayer& b, Layer&) { b.rotation = nan; }},
         {"period = [1.0, 2.5, 0.0]",
          [](NoiseLayer& b, Layer&) {
              b.period = {1, 2.5, 0};
          }},
         {"period = [-1.0, 0.0, 0.0]",
          [](NoiseLayer& b, Layer&) {
              b.period = {-1, 0, 0};
          }},
         {"fractal = \"ridged\"\noffset = 17.0",
          [](NoiseLayer& b, Layer&) { b.fractal = FractalKind::ridged, b.offset = 17; }},
         {"fractal = \"ridged\"\nfeedback = 1001.0",
          [](NoiseLayer& b, Layer&) { b.fractal = FractalKind::ridged, b.feedback = 1001; }},
         {"shape = { remap = [2.0, 2.0] }",
          [](NoiseLayer& b, Layer&) {
              b.shape.remap = {2, 2};
          }},
         {"shape = { power = 0.5 }", [](NoiseLayer& b, Layer&) { b.shape.power = 0.5; }},
         {"shape = { smoothstep = [1.0, nan] }",
          [](NoiseLayer& b, Layer&) {
              b.shape.smoothstep = {1, nan};
          }},
         {"shape = { bias = 1.0 }", [](NoiseLayer& b, Layer&) { b.shape.bias = 1; }},
         {"shape = { power = 2, bias = 0.5 }", [](NoiseLayer& b, Layer&) { b.shape.power = 2, b.shape.bias = 0.5; }}});
}

TEST_F(Check, NumbersOfMaps) {
    expect_same<HeightMapLayer>(
        texture_, {},
        {{"uv = { scale = [1.0, 0.0] }", [](HeightMapLayer& b, Layer&) { b.uv.scale[1] = 0; }},
         {"uv = { offset = [nan, 0.0] }", [](HeightMapLayer& b, Layer&) { b.uv.offset[0] = nan; }},
         {"uv = { rotation = nan }", [](HeightMapLayer& b, Layer&) { b.uv.rotation = nan; }},
         {"uv = { source = \"planar\", axis_u = [0.0, 0.0, 0.0] }",
          [](HeightMapLayer& b, Layer&) { b.uv.source = UvSource::planar, b.uv.axis_u = {}; }},
         {"upscale = \"taps\"\nwrap = \"clamp\"",
          [](HeightMapLayer& b, Layer&) { b.texture.upscale = Upscale::taps, b.texture.wrap = Wrap::clamp; }}});
    expect_same<NormalMapLayer>(texture_, {},
                                {{"uv = { rotation = 5 }\ntangents = \"passes\"", [](NormalMapLayer& b, Layer&) {
                                      b.uv.rotation = 5 * degree, b.tangents = TangentSource::planes;
                                  }}});
    expect_same<DerivativeMapLayer>(texture_, {},
                                    {{"scale = nan", [](DerivativeMapLayer&, Layer& l) { l.scale = nan; }}});
    expect_same<ObjectNormalLayer>(
        texture_, {},
        {{"object_to_world = [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0]]", [](ObjectNormalLayer& b, Layer&) {
              b.object_to_world[1] = {2, 0, 0};
          }}});
    expect_same<ParallaxLayer>(texture_, {},
                               {{"scale = 0.0", [](ParallaxLayer&, Layer& l) { l.scale = 0; }},
                                {"steps = 0", [](ParallaxLayer& b, Layer&) { b.steps = 0; }},
                                {"steps = 1025", [](ParallaxLayer& b, Layer&) { b.steps = 1025; }},
                                {"refine = -1", [](ParallaxLayer& b, Layer&) { b.refine = -1; }},
                                {"level = 1.5", [](ParallaxLayer& b, Layer&) { b.level = 1.5; }}});
}

TEST_F(Check, NumbersInSpace) {
    expect_same<ConstantLayer>("", {},
                               {{"gradient = [0.0, nan, 0.0]", [](ConstantLayer& b, Layer&) { b.gradient[1] = nan; }}});
    expect_same<TriplanarLayer>(
        texture_, {},
        {{"tile = 0.0", [](TriplanarLayer& b, Layer&) { b.tile = 0; }},
         {"sharpness = 0.0", [](TriplanarLayer& b, Layer&) { b.sharpness = 0; }},
         {"mode = \"geiss\"", [](TriplanarLayer& b, Layer&) { b.mode = TriplanarMode::geiss; }},
         {"transform = { translate = [0.0, 0.0, nan] }",
          [](TriplanarLayer& b, Layer&) { b.transform.translate[2] = nan; }},
         {"transform = { rotate = [nan, 0.0, 0.0] }", [](TriplanarLayer& b, Layer&) { b.transform.rotate[0] = nan; }},
         {"transform = { scale = [1.0, 0.0, 1.0] }", [](TriplanarLayer& b, Layer&) { b.transform.scale[1] = 0; }},
         {"planes = { y = { noise = { frequency = -1.0 }, scale = nan } }", [](TriplanarLayer& b, Layer&) {
              b.planes[1] = PlaneSource{NoiseLayer{.frequency = -1}, nan};
          }}});
    DecalLayer decal;
    decal.center = {1, 2, 3};
    expect_same<DecalLayer>(texture_ + "\ncenter = [1.0, 2.0, 3.0]", decal,
                            {{"axis_x = [0.0, 0.0, 0.0]", [](DecalLayer& b, Layer&) { b.axis_x = {}; }},
                             {"half_size = [1.0, 0.0, 1.0]",
                              [](DecalLayer& b, Layer&) {
                                  b.half_size = {1, 0, 1};
                              }},
                             {"falloff = 1.5", [](DecalLayer& b, Layer&) { b.falloff = 1.5; }}});
    expect_same<DecalLayer>(texture_, {}, {{"center = [nan, 0.0, 0.0]", [](DecalLayer& b, Layer&) {
                                                b.center = {nan, 0, 0};
                                            }}});
    VolumeLayer volume;
    volume.file = wall();
    expect_same<VolumeLayer>(
        "volume = \"textures/wall.png\"", volume,
        {{"remap = \"ramp\"\nrange = [1.0, 1.0]",
          [](VolumeLayer& b, Layer&) {
              b.remap = Remap::ramp, b.range = {1, 1};
          }},
         {"transform = [[0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]]",
          [](VolumeLayer& b, Layer&) { b.transform[0][0] = 0; }},
         {"transform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 1.0]]",
          [](VolumeLayer& b, Layer&) { b.transform[3][0] = 1; }}});
}

TEST_F(Check, KernelsOfTheUser) {
    KernelLayer bumps;
    bumps.file = wall();
    bumps.function = "bumps";
    bumps.parameters["depth"] = 1;
    expect_same<KernelLayer>(
        "file = \"textures/wall.png\"\nfunction = \"bumps\"", bumps,
        {{"parameters = { depth = nan }", [](KernelLayer& b, Layer&) { b.parameters["depth"] = nan; }},
         {"parameters = { float = 1.0 }",
          [](KernelLayer& b, Layer&) {
              b.parameters = {{"float", 1}};
          }},
         {"uv = { scale = [0.0, 1.0] }", [](KernelLayer& b, Layer&) {
              b.uv = UvMapping{.scale = {0, 1}};
          }}});
    bumps.function = "kernel";
    expect_refused(layer(bumps), {"\"function\" in layer \"bump\" must be a name as C has them"});
    bumps.function.clear();
    expect_refused(layer(bumps), {"layer \"bump\" needs \"function\""});
}

TEST_F(Check, NumbersOfLight) {
    const auto expect = [&](const std::string& text, const std::function<void(Lighting&)>& make) {
        Scene scene;
        scene.lighting.relight = Relight::lit;
        scene.lighting.lights = {{.kind = LightKind::spot}};
        make(scene.lighting);
        const std::string of_code = problems_of(scene);
        EXPECT_NE(of_code, "") << text;
        EXPECT_EQ(of_code, of_file("[lighting]\nrelight = \"lit\"\n" + text)) << text;
    };
    const std::string spot = "[[light]]\nkind = \"spot\"\nposition = [0, 0, 0]\n", down = "direction = [0, 0, -1]\n";
    expect("albedo = [0.5, 1.5, 0.5]\n" + spot + down, [](Lighting& l) { l.albedo[1] = 1.5; });
    expect("ambient = [-1.0, 0.0, 0.0]\n" + spot + down, [](Lighting& l) { l.ambient[0] = -1; });
    expect("roughness = nan\n" + spot + down, [](Lighting& l) { l.roughness = nan; });
    expect("f0 = 2.0\n" + spot + down, [](Lighting& l) { l.f0 = 2; });
    expect("max_ratio = 0.5\n" + spot + down, [](Lighting& l) { l.max_ratio = 0.5; });
    expect("exposure = 65.0\n" + spot + down, [](Lighting& l) { l.exposure = 65; });
    expect(spot + "direction = [0, 0, 0]\n", [](Lighting& l) { l.lights[0].direction = {}; });
    expect(spot + down + "intensity = -1.0\n", [](Lighting& l) { l.lights[0].intensity = -1; });
    expect(spot + down + "color = [1.0, nan, 1.0]\n", [](Lighting& l) { l.lights[0].color[1] = nan; });
    expect("[[light]]\nkind = \"spot\"\nposition = [nan, 0, 0]\n" + down,
           [](Lighting& l) { l.lights[0].position[0] = nan; });
    expect(spot + down + "inner_angle = 50\n", [](Lighting& l) { l.lights[0].inner_angle = 50 * degree; });
    expect("", [](Lighting& l) { l.lights.clear(); });
}

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
    odd.mask.cryptomatte = "";
    expect_refused(odd, {"mask of layer \"bump\" needs \"cryptomatte\""});

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
