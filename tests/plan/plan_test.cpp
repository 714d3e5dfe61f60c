// A plan holds what its scene needs and nothing else.
#include <algorithm>

#include "tests/plan/planned.h"

namespace wrinkle::test {
namespace {

TEST(Plan, OfNoLayersOnlyDecodesAndWrites) {
    const Plan plan = make_plan(scene_of({}), everything());
    EXPECT_EQ(plan.inputs, (Names{"depth", "normal.x", "normal.y", "normal.z"}));
    EXPECT_EQ(plan.outputs, (Names{"normal.x", "normal.y", "normal.z"}));
    EXPECT_EQ(titles(plan), (Names{"decode the G-buffer", "write"}));
    for (const char* part :
         {"dp_dx", "in_uv", "in_object", "wr_fractal", "wr_texture", "wr_light_surface", "wr_projector_"})
        EXPECT_FALSE(mentions(plan, part)) << part;
    EXPECT_TRUE(plan.textures.empty() && plan.eye_places.empty() && plan.decals.empty());
    EXPECT_FALSE(plan.neighbours);
    EXPECT_EQ(plan.bytes, 4.0 * (4 + 3));
}

TEST(Plan, UnprojectedGradientsNeedNoProjection) {
    Layer noise = layer(NoiseLayer{});
    EXPECT_TRUE(mentions(make_plan(scene_of({noise}), everything()), "wr_surface_gradient_from_volume"));
    noise.project = false;
    EXPECT_FALSE(mentions(make_plan(scene_of({noise}), everything()), "wr_surface_gradient_from_volume"));
}

TEST(Plan, OriginsRepeatAsTheirLayersDo) {
    Layer planar = layer(normal_map()), clamped = planar;
    std::get<NormalMapLayer>(planar.bump).uv = {.source = UvSource::planar, .scale = {2, 4}, .offset = {0.25, 0.5}};
    std::get<NormalMapLayer>(clamped.bump).uv.source = UvSource::planar;
    std::get<NormalMapLayer>(clamped.bump).texture.wrap = Wrap::clamp;
    TriplanarLayer tiles;
    tiles.texture.file = "rock.png";
    tiles.tile = 4;
    const Scene scene = scene_of({planar, clamped, layer(tiles), layer(NoiseLayer{.frequency = 3, .octaves = 2})});
    const Available all = everything();
    const Plan plan = make_plan(scene, all);
    ASSERT_EQ(plan.eye_places.size(), 5u);
    std::vector<EyePlace> places;
    for (const PlannedEyePlace& planned : plan.eye_places) places.push_back(planned({scene, all.cryptomatte}));
    EXPECT_EQ(places[0].period, Periods(1));
    EXPECT_EQ(places[0].axes[1], (Vec3{0, 4, 0}));
    EXPECT_EQ(places[0].offset, (Vec3{0.25, 0.5, 0}));
    EXPECT_EQ(places[1].period, Periods(0)) << "a clamped coordinate must not be reduced";
    EXPECT_EQ(places[2].axes[2], (Vec3{0, 0, 0.25}));
    EXPECT_EQ(places[3].axes[0], (Vec3{3, 0, 0}));
    EXPECT_EQ(places[4].axes[0], (Vec3{6, 0, 0}));
    EXPECT_EQ(places[3].period, Periods(256));
}

TEST(Plan, DerivesTextureCoordinatesWhereMasksWantThem) {
    Layer woven = layer(normal_map(), "weave"), dirty = woven, anywhere = woven;
    woven.mask.object = {3};
    dirty.mask.channel = "dirt", dirty.mask.invert = true;
    const auto wanted = [](std::vector<Layer> layers, const PlanOptions& options = {}, bool marked = false) {
        Scene scene = scene_of(std::move(layers));
        scene.output.marked = marked;
        Available bare = everything();
        std::erase_if(bare.planes, [](const std::string& name) { return name.starts_with("d"); });
        bare.planes.insert("depth");  // without planes of derivatives, they come from neighbours
        return mentions(make_plan(scene, bare, options), "usable = uv_valid & wanted");
    };
    EXPECT_TRUE(wanted({woven}));
    EXPECT_TRUE(wanted({woven, dirty, layer(NoiseLayer{})})) << "noise needs none";
    EXPECT_FALSE(wanted({woven, anywhere}));
    EXPECT_FALSE(wanted({woven}, {}, true)) << "where there are none is written";
    EXPECT_FALSE(wanted({woven}, {.split = true}));
    EXPECT_FALSE(wanted({woven}, {.skip = false}));
    Layer painted = woven;
    painted.mask.texture = MaskTexture{.file = "rust.png"};
    EXPECT_TRUE(wanted({painted}));
    painted.mask.invert = true;
    EXPECT_FALSE(wanted({painted})) << "wherever the texture is not 1, whatever the object";
}

TEST(Plan, ListsSectionsByStage) {
    Scene scene =
        scene_of({layer(ConstantLayer{{1, 0, 0}}, "tilt"), layer(ResolveLayer{}), layer(NoiseLayer{}, "grain")});
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights.resize(2);
    const Plan plan = make_plan(scene, everything());
    EXPECT_EQ(titles(plan), (Names{"decode the G-buffer", "constant \"tilt\"", "resolve", "noise \"grain\"", "resolve",
                                   "relight the picture by lit(new) / lit(old)", "write"}));
    std::vector<int> stages;
    for (const SectionSummary& section : plan.sections) {
        stages.push_back(section.stage);
        EXPECT_GE(section.operations, 0);
    }
    EXPECT_EQ(stages, (std::vector<int>{0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(plan.sections[5].planes,
              (Names{"albedo.b", "albedo.g", "albedo.r", "beauty.b", "beauty.g", "beauty.r", "emission.b", "emission.g",
                     "emission.r", "metallic", "roughness", "specular.b", "specular.g", "specular.r", "transmission.b",
                     "transmission.g", "transmission.r"}));
    EXPECT_EQ(plan.kernels.size(), 1u);
    PlanOptions split;
    split.split = true;
    EXPECT_EQ(make_plan(scene, everything(), split).kernels.size(), plan.sections.size());
}

TEST(Plan, WritesWhatTheSceneAsksFor) {
    Scene scene = scene_of({});
    scene.output = {.surface_gradient = true, .dp_dx = true, .marked = true};
    const Names outputs = make_plan(scene, everything()).outputs;
    EXPECT_EQ(outputs, (Names{"normal.x", "normal.y", "normal.z", "surface_gradient.x", "surface_gradient.y",
                              "surface_gradient.z", "dp_dx.x", "dp_dx.y", "dp_dx.z", "marked"}));
}

}  // namespace
}  // namespace wrinkle::test
