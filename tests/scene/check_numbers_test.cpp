// Numbers of scenes made in code: refused where those of files are, in the same words.
#include "tests/scene/scene_in_code.h"

namespace wrinkle {
namespace {

TEST_F(Check, NumbersOfEveryLayer) {
    expect_same<NoiseLayer>(
        "", {},
        {{"scale = nan", [](NoiseLayer&, Layer& l) { l.scale = nan; }},
         {"scale = 1e39", [](NoiseLayer&, Layer& l) { l.scale = 1e39; }},
         {"mask = { object = inf }",
          [](NoiseLayer&, Layer& l) { l.mask.object = {std::numeric_limits<double>::infinity()}; }},
         {"mask = { cryptomatte = \"#12\" }", [](NoiseLayer&, Layer& l) { l.mask.cryptomatte = {"#12"}; }},
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

}  // namespace
}  // namespace wrinkle
