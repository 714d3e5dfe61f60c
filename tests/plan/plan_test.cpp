// A plan holds what its scene needs and nothing else.
#include "plan/plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "wrinkle/error.h"
#include "wrinkle/gbuffer.h"

namespace wrinkle {
namespace {

Available everything() {
    Available all;
    for (const Role& role : gbuffer_roles()) all.planes.insert(role.planes.begin(), role.planes.end());
    all.planes.insert({"crypto.id0", "crypto.coverage0", "channel:dirt"});
    all.cryptomatte = {{"Rock", 0x12345678u}, {"Wall", 0x9abcdef0u}};
    return all;
}

Layer layer(decltype(Layer::bump) bump, const std::string& name = "bump") {
    Layer l;
    l.name = name;
    l.bump = std::move(bump);
    return l;
}

NormalMapLayer normal_map() {
    NormalMapLayer l;
    l.texture.file = "weave.png";
    return l;
}

DecalLayer decal(const char* file = "seal.png") {
    DecalLayer l;
    l.texture.file = file;
    l.texture.wrap = Wrap::clamp;
    return l;
}

Scene scene_of(std::vector<Layer> layers) {
    Scene scene;
    scene.layers = std::move(layers);
    return scene;
}

/// The kernels without the list of concept files before them.
std::string kernels(const Plan& plan) { return plan.source.substr(plan.source.rfind("#include")); }
bool mentions(const Plan& plan, const std::string& text) { return kernels(plan).find(text) != std::string::npos; }

using Names = std::vector<std::string>;

std::vector<std::string> titles(const Plan& plan) {
    std::vector<std::string> list;
    for (const SectionSummary& section : plan.sections) list.push_back(section.title);
    return list;
}

std::string refusal(const Scene& scene, const Available& available) {
    try {
        make_plan(scene, available);
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

void expect_mentions(const std::string& text, const Names& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

TEST(Plan, OfNoLayersOnlyDecodesAndWrites) {
    const Plan plan = make_plan(scene_of({}), everything());
    EXPECT_EQ(plan.inputs, (Names{"depth", "normal.x", "normal.y", "normal.z"}));
    EXPECT_EQ(plan.outputs, (Names{"normal.x", "normal.y", "normal.z"}));
    EXPECT_EQ(titles(plan), (Names{"decode the G-buffer", "write"}));
    for (const char* part :
         {"dp_dx", "in_uv", "in_object", "wr_fractal", "wr_texture", "wr_light_surface", "wr_decal_"})
        EXPECT_FALSE(mentions(plan, part)) << part;
    EXPECT_TRUE(plan.textures.empty() && plan.origins.empty() && plan.decals.empty());
    EXPECT_FALSE(plan.neighbours);
    EXPECT_EQ(plan.bytes, 4.0 * (4 + 3));
}

TEST(Plan, ReadsTheUvPlaneOnlyForLayersOnIt) {
    Layer planar = layer(normal_map());
    std::get<NormalMapLayer>(planar.bump).uv.source = UvSource::planar;
    const Plan without = make_plan(scene_of({planar, layer(NoiseLayer{}), layer(decal())}), everything());
    EXPECT_FALSE(mentions(without, "in_uv"));
    EXPECT_FALSE(mentions(without, "wr_texcoord_difference"));
    const Plan with = make_plan(scene_of({layer(normal_map())}), everything());
    EXPECT_TRUE(std::ranges::count(with.inputs, "uv.u") == 1 && std::ranges::count(with.inputs, "uv.v") == 1);
    EXPECT_FALSE(mentions(with, "wr_fractal"));
}

TEST(Plan, TakesTheBestUvDerivativesThereAre) {
    const Scene scene = scene_of({layer(normal_map())});
    Available available = everything();
    const auto has = [&](const char* plane) {
        return std::ranges::count(make_plan(scene, available).inputs, plane) > 0;
    };
    EXPECT_TRUE(has("duv_dx.u") && !has("dp_du.x") && !has("object"));
    available.planes.erase("duv_dx.u");
    EXPECT_TRUE(!has("duv_dy.u") && has("dp_du.x") && !has("object"));
    EXPECT_FALSE(make_plan(scene, available).neighbours);
    available.planes.erase("dp_dv.z");
    EXPECT_TRUE(!has("dp_du.x") && has("object"));
    EXPECT_TRUE(make_plan(scene, available).neighbours);
    available.planes.erase("object");
    EXPECT_FALSE(has("object"));
}

TEST(Plan, ParallaxMovesTheUvPlaneOnlyForLayersAfterIt) {
    ParallaxLayer depth;
    depth.texture.file = "stones.png";
    depth.uv.source = UvSource::planar;
    const auto plan = [&](std::vector<Layer> layers) { return make_plan(scene_of(std::move(layers)), everything()); };
    EXPECT_FALSE(mentions(plan({layer(depth), layer(NoiseLayer{})}), "uv"));
    EXPECT_FALSE(mentions(plan({layer(normal_map(), "first"), layer(depth)}), "uv.st = wr_add"));
    EXPECT_TRUE(mentions(plan({layer(depth), layer(normal_map(), "last")}), "uv.st = wr_add"));
    EXPECT_FALSE(plan({layer(depth)}).neighbours);
    depth.curved = true;
    EXPECT_TRUE(plan({layer(depth)}).neighbours);
    Layer deep = layer(depth, "deep");
    deep.scale = -1;
    expect_mentions(refusal(scene_of({deep}), everything()), {"deep", "scale is -1", "above 0"});
}

TEST(Plan, PrefersDepthUnlessTheSceneOrTheCameraSaysOtherwise) {
    Scene scene = scene_of({});
    Available available = everything();
    const auto inputs = [&] { return make_plan(scene, available).inputs; };
    EXPECT_EQ(inputs().front(), "depth");
    available.camera = CameraKind::general;
    EXPECT_EQ(inputs().back(), "position.z");
    available.camera = CameraKind::parallel;
    EXPECT_EQ(inputs().front(), "depth");
    available.ray_depth = true;
    EXPECT_EQ(inputs().back(), "position.z");
    available = everything();
    scene.gbuffer.geometry = Geometry::position;
    EXPECT_EQ(inputs().back(), "position.z");
    scene.gbuffer.geometry = Geometry::depth;
    available.camera = CameraKind::general;
    expect_mentions(refusal(scene, available), {"depth", "pinhole", "position"});
}

TEST(Plan, ComputesDerivativesOnlyForWhatUsesThem) {
    EXPECT_FALSE(mentions(make_plan(scene_of({layer(ConstantLayer{{1, 0, 0}})}), everything()), "dp_dx"));
    Layer noise = layer(NoiseLayer{});
    EXPECT_TRUE(mentions(make_plan(scene_of({noise}), everything()), "dp_dx"));
    noise.footprint = false;
    EXPECT_FALSE(mentions(make_plan(scene_of({noise}), everything()), "dp_dx"));
}

TEST(Plan, NamesTheLayerAndThePlanesItLacks) {
    Available bare = everything();
    for (const char* plane : {"uv.u", "object", "crypto.id0", "channel:dirt", "beauty.g"}) bare.planes.erase(plane);
    Layer weave = layer(normal_map(), "weave");
    weave.location = "scene.toml:12";
    expect_mentions(refusal(scene_of({weave}), bare), {"scene.toml:12", "weave", "uv.u", "normal.x"});
    Layer masked = layer(ConstantLayer{}, "moss");
    masked.mask.object = 3;
    expect_mentions(refusal(scene_of({masked}), bare), {"moss", "object"});
    masked.mask = {};
    masked.mask.channel = "dirt";
    expect_mentions(refusal(scene_of({masked}), bare), {"moss", "dirt"});
    masked.mask = {};
    masked.mask.cryptomatte = "Rock";
    expect_mentions(refusal(scene_of({masked}), bare), {"moss", "crypto.id0"});
    masked.mask.cryptomatte = "Rok";
    expect_mentions(refusal(scene_of({masked}), everything()), {"moss", "\"Rok\"", "Rock, Wall"});
    Scene ratio = scene_of({});
    ratio.lighting.relight = Relight::ratio;
    expect_mentions(refusal(ratio, bare), {"ratio", "beauty.g"});
    bare.planes = {};
    expect_mentions(refusal(scene_of({}), bare), {"depth", "nothing"});
}

TEST(Plan, CryptomatteNamesBecomeTheirHashes) {
    Layer masked = layer(ConstantLayer{{1, 0, 0}});
    masked.mask.cryptomatte = "Rock";
    EXPECT_TRUE(mentions(make_plan(scene_of({masked}), everything()), fmt::format("{}u", 0x12345678u)));
    masked.mask.cryptomatte = "#0000beef";
    EXPECT_TRUE(mentions(make_plan(scene_of({masked}), everything()), fmt::format("{}u", 0xbeefu)));
}

TEST(Plan, HeightsOfAChannelReadTheirNeighboursOnly) {
    const Plan plan = make_plan(scene_of({layer(HeightChannelLayer{"dirt"})}), everything());
    EXPECT_TRUE(plan.neighbours);
    EXPECT_EQ(plan.inputs, (Names{"channel:dirt", "depth", "normal.x", "normal.y", "normal.z", "object"}));
    expect_mentions(refusal(scene_of({layer(HeightChannelLayer{"dust"}, "wear")}), everything()),
                    {"wear", "the channel \"dust\"", "nearest: \"dirt\""});
}

TEST(Plan, UnprojectedGradientsNeedNoProjection) {
    Layer noise = layer(NoiseLayer{});
    EXPECT_TRUE(mentions(make_plan(scene_of({noise}), everything()), "wr_surface_gradient_from_volume"));
    noise.project = false;
    EXPECT_FALSE(mentions(make_plan(scene_of({noise}), everything()), "wr_surface_gradient_from_volume"));
}

TEST(Plan, GroupsDecalsThatShareMaskAndSampling) {
    Layer masked = layer(decal(), "c");
    masked.mask.object = 3;
    Layer plain = layer(decal(), "d");
    std::get<DecalLayer>(plain.bump).texture.upscale = Upscale::plain;
    Layer undone = layer(decal("crack.png"), "b");
    undone.blend = Blend::subtract;
    undone.scale = 2;
    const Plan plan = make_plan(scene_of({layer(decal(), "a"), undone, masked, plain}), everything());
    EXPECT_EQ(titles(plan), (Names{"decode the G-buffer", "decal \"a\" and 1 more", "decal \"c\"", "decal \"d\"",
                                   "resolve", "write"}));
    EXPECT_EQ(plan.decals.size(), 4u);
    EXPECT_EQ(plan.decal_scales, (std::vector<double>{1, -2, 1, 1}));
    EXPECT_EQ(plan.decal_textures, (std::vector<std::size_t>{0, 1, 0, 2}));  // the same file as height and as slope
    EXPECT_EQ(plan.textures.size(), 3u);
    EXPECT_TRUE(mentions(plan, "i = 0; i < 2") && mentions(plan, "i = 2; i < 3") && mentions(plan, "i = 3; i < 4"));
}

Layer table(std::vector<Projector> rows, const std::string& name = "table") {
    DecalsLayer l;
    l.textures = {{.file = "seal.png"}, {.file = "weave.png", .content = Content::normal}};
    l.rows = std::make_shared<const std::vector<Projector>>(std::move(rows));
    return layer(l, name);
}

TEST(Plan, TablesOfDecalsShareAProgramWhateverTheirLength) {
    const Plan one = make_plan(scene_of({table(std::vector<Projector>(3))}), everything());
    const Plan other = make_plan(scene_of({table(std::vector<Projector>(500))}), everything());
    EXPECT_EQ(one.source, other.source);
    EXPECT_EQ(other.projectors, 500u);
    EXPECT_TRUE(other.tiles && mentions(other, "wr_bin_lists"));
    EXPECT_FALSE(mentions(other, "in_object") || mentions(other, "crypto"));
    EXPECT_FALSE(mentions(make_plan(scene_of({layer(decal())}), everything()), "wr_bin_"));
    EXPECT_FALSE(make_plan(scene_of({table({})}), everything()).tiles);
    const Plan two =
        make_plan(scene_of({table(std::vector<Projector>(3)), table(std::vector<Projector>(4), "b")}), everything());
    EXPECT_TRUE(mentions(two, "number < 0u || number >= 3u") && mentions(two, "number < 3u || number >= 7u"));
}

TEST(Plan, RowsOfATableBringTheirMasksAndRegions) {
    std::vector<Projector> rows(4);
    rows[0].object = 3;
    rows[1].cryptomatte = "Rock";
    rows[2].region = {0, 0, 0.5, 0.5};
    rows[3].texture = 1;
    const Plan plan = make_plan(scene_of({table(rows)}), everything());
    EXPECT_TRUE(std::ranges::count(plan.inputs, "object") == 1 && std::ranges::count(plan.inputs, "crypto.id0") == 1);
    EXPECT_EQ(plan.tables[0].hashes, (std::vector<std::uint32_t>{0, 0x12345678u, 0, 0}));
    EXPECT_EQ(plan.textures.size(), 3u);
    EXPECT_EQ(plan.textures[1].region, rows[2].region);
    EXPECT_TRUE(plan.tables[0].images[2].height && !plan.tables[0].images[3].height);
    rows[1].cryptomatte = "Rok";
    rows[1].line = 12;
    Layer wear = table(rows, "wear");
    expect_mentions(refusal(scene_of({wear}), everything()), {"layer \"wear\": row 1 ", "\"Rok\""});
    std::get<DecalsLayer>(wear.bump).file = "shots/decals.csv";
    expect_mentions(refusal(scene_of({wear}), everything()), {"layer \"wear\": shots/decals.csv:12 ", "\"Rok\""});
    rows[3].texture = 2;
    expect_mentions(refusal(scene_of({table(rows)}), everything()), {"texture 2", "has 2"});
}

TEST(Plan, TexturesKnowTheFirstLayerThatUsesThem) {
    Layer masked = layer(ConstantLayer{}, "masked");
    masked.location = "scene.toml:9";
    masked.mask.texture = MaskTexture{.file = "dirt.png"};
    const Plan plan = make_plan(
        scene_of({layer(normal_map(), "cloth"), layer(normal_map(), "again"), masked, table({Projector{}}, "wear")}),
        everything());
    ASSERT_EQ(plan.textures.size(), 3u);
    EXPECT_EQ(plan.textures[0].layer, "layer \"cloth\"");
    EXPECT_EQ(plan.textures[1].layer, "scene.toml:9: layer \"masked\"");
    EXPECT_EQ(plan.textures[2].layer, "layer \"wear\"");
}

TEST(Plan, ARegionIsNoTextureForOtherLayers) {
    std::vector<Projector> rows(1);
    rows[0].region = {0, 0, 0.5, 0.5};
    HeightMapLayer whole;
    whole.texture.file = "seal.png";
    whole.texture.wrap = Wrap::clamp;
    const Plan plan = make_plan(scene_of({table(rows), layer(whole)}), everything());
    ASSERT_EQ(plan.textures.size(), 2u);
    EXPECT_EQ(plan.textures[1].region, (std::array<double, 4>{0, 0, 1, 1}));
}

TEST(Plan, TablesOfDecalsStandBeforeAParallaxOrAfter) {
    ParallaxLayer depth;
    depth.texture.file = "stones.png";
    const Layer wear = table(std::vector<Projector>(2), "wear"), stones = layer(depth, "stones");
    EXPECT_TRUE(make_plan(scene_of({wear, stones}), everything()).tiles);
    EXPECT_TRUE(make_plan(scene_of({stones, wear}), everything()).tiles);
}

TEST(Plan, OrdersTablesThatReplaceByPriorityAndOthersByPlace) {
    std::vector<Projector> rows(3);
    rows[0].priority = 2, rows[1].priority = 1, rows[2].priority = 1;
    rows[0].center = {0, 0, 0}, rows[1].center = {9, 9, 9}, rows[2].center = {1, 0, 0};
    EXPECT_EQ(make_plan(scene_of({table(rows)}), everything()).tables[0].order, (std::vector<std::uint32_t>{0, 2, 1}));
    rows[2].mode = ProjectorMode::replace;
    EXPECT_EQ(make_plan(scene_of({table(rows)}), everything()).tables[0].order, (std::vector<std::uint32_t>{1, 2, 0}));
}

TEST(Plan, DecalsThatMixNormalsStandByThemselvesAndNeedANormal) {
    DecalLayer mixed = decal();
    mixed.mode = DecalMode::projector;
    const Scene scene = scene_of({layer(decal(), "bumps"), layer(mixed, "mixes")});
    const Names all = titles(make_plan(scene, everything()));
    EXPECT_EQ(std::ranges::count(all, "decal \"bumps\""), 1);
    EXPECT_EQ(std::ranges::count(all, "decal \"mixes\""), 1);
    EXPECT_THROW(make_plan(scene, everything(), {.normal = false, .view_footprint = true}), Error);
}

TEST(Plan, OriginsRepeatAsTheirLayersDo) {
    Layer planar = layer(normal_map()), clamped = planar;
    std::get<NormalMapLayer>(planar.bump).uv = {.source = UvSource::planar, .scale = {2, 4}, .offset = {0.25, 0.5}};
    std::get<NormalMapLayer>(clamped.bump).uv.source = UvSource::planar;
    std::get<NormalMapLayer>(clamped.bump).texture.wrap = Wrap::clamp;
    TriplanarLayer tiles;
    tiles.texture.file = "rock.png";
    tiles.tile = 4;
    const Plan plan = make_plan(
        scene_of({planar, clamped, layer(tiles), layer(NoiseLayer{.frequency = 3, .octaves = 2})}), everything());
    ASSERT_EQ(plan.origins.size(), 5u);
    EXPECT_EQ(plan.origins[0].period, Periods(1));
    EXPECT_EQ(plan.origins[0].axes[1], (Vec3{0, 4, 0}));
    EXPECT_EQ(plan.origins[0].offset, (Vec3{0.25, 0.5, 0}));
    EXPECT_EQ(plan.origins[1].period, Periods(0)) << "a clamped coordinate must not be reduced";
    EXPECT_EQ(plan.origins[2].axes[2], (Vec3{0, 0, 0.25}));
    EXPECT_EQ(plan.origins[3].axes[0], (Vec3{3, 0, 0}));
    EXPECT_EQ(plan.origins[4].axes[0], (Vec3{6, 0, 0}));
    EXPECT_EQ(plan.origins[3].period, Periods(256));
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
              (Names{"albedo.b", "albedo.g", "albedo.r", "beauty.b", "beauty.g", "beauty.r", "roughness"}));
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
}  // namespace wrinkle
