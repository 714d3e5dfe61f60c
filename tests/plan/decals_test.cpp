// Decals with the same mask and sampling share a loop in the kernel; tables of decals share a program.
#include <algorithm>

#include "tests/plan/planned.h"

namespace wrinkle::test {
namespace {

Layer table(std::vector<Projector> rows, const std::string& name = "table") {
    DecalsLayer l;
    l.textures = {{.file = "seal.png"}, {.file = "weave.png", .content = Content::normal}};
    l.rows = std::make_shared<const std::vector<Projector>>(std::move(rows));
    return layer(l, name);
}

TEST(PlanOfDecals, GroupsDecalsThatShareMaskAndSampling) {
    Layer masked = layer(decal(), "c");
    masked.mask.object = {3};
    Layer plain = layer(decal(), "d");
    std::get<DecalLayer>(plain.bump).texture.upscale = Upscale::plain;
    Layer undone = layer(decal("crack.png"), "b");
    undone.blend = Blend::subtract;
    undone.scale = 2;
    Layer also_masked = masked;  // whose object another scene may change
    EXPECT_EQ(std::ranges::count(titles(make_plan(scene_of({masked, also_masked}), everything())), "decal \"c\""), 2);
    const Plan plan = make_plan(scene_of({layer(decal(), "a"), undone, masked, plain}), everything());
    EXPECT_EQ(titles(plan), (Names{"decode the G-buffer", "decal \"a\" and 1 more", "decal \"c\"", "decal \"d\"",
                                   "resolve", "write"}));
    EXPECT_EQ(plan.decals.size(), 4u);
    std::vector<std::uint32_t> textures;
    for (const PlannedDecal& planned : plan.decals) textures.push_back(planned.image.texture);
    EXPECT_EQ(textures,
              (std::vector<std::uint32_t>{0, 1, 0, 2}));  // a file used as heights and as slopes is two textures
    EXPECT_EQ(plan.textures.size(), 3u);
    EXPECT_TRUE(mentions(plan, "i = 0, rest = crosses_0;") && mentions(plan, "i = 2, rest = crosses_2;") &&
                mentions(plan, "i = 3, rest = crosses_3;"));
}

TEST(PlanOfDecals, AnAreaAsksOnceWhichOfThemItMayCross) {
    const std::vector<Layer> many(70, layer(decal(), "a"));
    const Plan plan = make_plan(scene_of(many), everything());
    EXPECT_TRUE(mentions(plan, "i = 0, rest = crosses_0;") && mentions(plan, "i = 32, rest = crosses_32;") &&
                mentions(plan, "i = 64, rest = crosses_64;"));
    Scene one = scene_of(many);
    one.filter.taps = 1;
    EXPECT_FALSE(mentions(make_plan(one, everything()), "crosses_"));
}

TEST(PlanOfDecals, TablesOfDecalsShareAProgramWhateverTheirLength) {
    const Plan one = make_plan(scene_of({table(std::vector<Projector>(3))}), everything());
    const Plan other = make_plan(scene_of({table(std::vector<Projector>(500))}), everything());
    EXPECT_EQ(one.source, other.source);
    EXPECT_EQ(other.projectors, 500u);
    EXPECT_TRUE(other.tiles && mentions(other, "wr_bin_lists"));
    EXPECT_FALSE(mentions(other, "in_object") || mentions(other, "crypto"));
    EXPECT_FALSE(mentions(make_plan(scene_of({layer(decal())}), everything()), "wr_bin_"));
    EXPECT_FALSE(make_plan(scene_of({table({})}), everything()).tiles);
    const Scene both = scene_of({table(std::vector<Projector>(3)), table(std::vector<Projector>(70000), "b")});
    const Plan two = make_plan(both, everything());
    EXPECT_EQ(numbers(two, both, "first and last row"), (std::vector<double>{0, 0, 0, 3, 0, 3, 1, 70003 - 65536}));
    EXPECT_EQ(two.source, make_plan(scene_of({table(std::vector<Projector>(8)), table(std::vector<Projector>(4), "b")}),
                                    everything())
                              .source);
}

TEST(PlanOfDecals, RowsOfATableBringTheirMasksAndRegions) {
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

TEST(PlanOfDecals, TexturesKnowTheFirstLayerThatUsesThem) {
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

TEST(PlanOfDecals, ARegionIsNoTextureForOtherLayers) {
    std::vector<Projector> rows(1);
    rows[0].region = {0, 0, 0.5, 0.5};
    HeightMapLayer whole;
    whole.texture.file = "seal.png";
    whole.texture.wrap = Wrap::clamp;
    const Plan plan = make_plan(scene_of({table(rows), layer(whole)}), everything());
    ASSERT_EQ(plan.textures.size(), 2u);
    EXPECT_EQ(plan.textures[1].region, (std::array<double, 4>{0, 0, 1, 1}));
}

TEST(PlanOfDecals, TablesOfDecalsStandBeforeAParallaxOrAfter) {
    ParallaxLayer depth;
    depth.texture.file = "stones.png";
    const Layer wear = table(std::vector<Projector>(2), "wear"), stones = layer(depth, "stones");
    EXPECT_TRUE(make_plan(scene_of({wear, stones}), everything()).tiles);
    EXPECT_TRUE(make_plan(scene_of({stones, wear}), everything()).tiles);
}

TEST(PlanOfDecals, OrdersTablesThatReplaceByPriorityAndOthersByPlace) {
    std::vector<Projector> rows(3);
    rows[0].priority = 2, rows[1].priority = 1, rows[2].priority = 1;
    rows[0].center = {0, 0, 0}, rows[1].center = {9, 9, 9}, rows[2].center = {1, 0, 0};
    EXPECT_EQ(make_plan(scene_of({table(rows)}), everything()).tables[0].order, (std::vector<std::uint32_t>{0, 2, 1}));
    rows[2].mode = ProjectorMode::replace;
    EXPECT_EQ(make_plan(scene_of({table(rows)}), everything()).tables[0].order, (std::vector<std::uint32_t>{1, 2, 0}));
}

TEST(PlanOfDecals, DecalsThatMixNormalsStandByThemselvesAndNeedANormal) {
    DecalLayer mixed = decal();
    mixed.mode = DecalMode::projector;
    const Scene scene = scene_of({layer(decal(), "bumps"), layer(mixed, "mixes")});
    const Names all = titles(make_plan(scene, everything()));
    EXPECT_EQ(std::ranges::count(all, "decal \"bumps\""), 1);
    EXPECT_EQ(std::ranges::count(all, "decal \"mixes\""), 1);
    EXPECT_THROW(make_plan(scene, everything(), {.normal = false, .view_footprint = true}), Error);
}

}  // namespace
}  // namespace wrinkle::test
