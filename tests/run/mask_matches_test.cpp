// A warning tells of masks that no pixel matches, once for each layer.
#include "run/mask_matches.h"

#include <gtest/gtest.h>

#include <bit>

namespace wrinkle {
namespace {

using Lines = std::vector<std::string>;

Layer layer(const std::string& name) {
    Layer l;
    l.name = name;
    l.location = "scene.toml:7";
    l.bump = ConstantLayer{};
    return l;
}

Layer on_object(const std::string& name, double object, bool invert = false) {
    Layer l = layer(name);
    l.mask.object = {object};
    l.mask.invert = invert;
    return l;
}

Layer on_name(const std::string& name, const std::string& cryptomatte) {
    Layer l = layer(name);
    l.mask.cryptomatte = {cryptomatte};
    return l;
}

Layer table(std::vector<Projector> rows) {
    Layer l = layer("wear");
    l.bump = DecalsLayer{.rows = std::make_shared<const std::vector<Projector>>(std::move(rows)), .file = "wear.csv"};
    return l;
}

Scene scene_of(std::vector<Layer> layers) {
    Scene scene;
    scene.filter.taps = 1;
    scene.layers = std::move(layers);
    return scene;
}

Frame frame() {
    Frame f;
    f.cryptomatte = {{"Rock", 0x3f800001u}, {"Wall", 0x40000002u}, {"Sky", 0x40400003u}, {"#40800004", 0x40800004u}};
    return f;
}

void see_objects(MaskMatches& matches, const std::vector<float>& objects) {
    matches.see({{"object", objects.data()}}, objects.size());
}

TEST(MaskMatches, TellTheIndicesThatAFrameHas) {
    MaskMatches matches(scene_of({layer("all"), on_object("dents", 3), on_object("weave", 7)}));
    matches.begin(frame());
    see_objects(matches, {0, 0, 1, 1, 0, -0.0f});
    see_objects(matches, {10, 3, 3, 0});
    EXPECT_EQ(matches.warnings(),
              (Lines{"scene.toml:7: layer \"weave\": no pixel has object 7; the frame has 0, 1, 3, 10"}));
    see_objects(matches, {1, 7});
    EXPECT_EQ(matches.warnings(), Lines{});
}

TEST(MaskMatches, FindBothZerosAndIndicesThatFloatsRound) {
    MaskMatches matches(scene_of({on_object("a", 0), on_object("b", 0.1), on_object("c", 0.2)}));
    matches.begin(frame());
    see_objects(matches, {-0.0f, 0.1f, 0.3f});
    ASSERT_EQ(matches.warnings().size(), 1u);
    EXPECT_NE(matches.warnings()[0].find("\"c\": no pixel has object 0.2;"), std::string::npos);
}

TEST(MaskMatches, ListTheFirstIndicesOnly) {
    MaskMatches matches(scene_of({on_object("weave", -1)}));
    matches.begin(frame());
    std::vector<float> objects;
    for (int i = 0; i < 1000; ++i) objects.push_back(static_cast<float>(i));
    see_objects(matches, objects);
    const std::string line = matches.warnings().at(0);
    EXPECT_TRUE(line.ends_with("has 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, ...")) << line;
    see_objects(matches, {-1});
    EXPECT_EQ(matches.warnings(), Lines{}) << "found although the list is full";
}

TEST(MaskMatches, WantOneOfAPatternAndAllOfAList) {
    Layer some = on_object("some", 1);
    some.mask.object = {1, 4};
    MaskMatches matches(scene_of({some, on_name("all", "*"), on_name("rocks", "Roc?"), on_name("walls", "Wa*")}));
    matches.begin(frame());
    const std::vector<float> id{std::bit_cast<float>(0x3f800001u)}, coverage{1}, object{1};
    matches.see({{"object", object.data()}, {"crypto.id0", id.data()}, {"crypto.coverage0", coverage.data()}}, 1);
    EXPECT_EQ(
        matches.warnings(),
        (Lines{"scene.toml:7: layer \"some\": no pixel has object 4; the frame has 1",
               "scene.toml:7: layer \"walls\": no pixel has the Cryptomatte object \"Wa*\"; the frame has Rock"}));
}

TEST(MaskMatches, LookAtEveryRankThatCoversSomething) {
    MaskMatches matches(
        scene_of({on_name("a", "Rock"), on_name("b", "Wall"), on_name("c", "Sky"), on_name("d", "#40800004")}));
    matches.begin(frame());
    const auto ids = [](std::vector<std::uint32_t> bits) {
        std::vector<float> out;
        for (const std::uint32_t each : bits) out.push_back(std::bit_cast<float>(each));
        return out;
    };
    const std::vector<float> id0 = ids({0x3f800001u, 0x3f800001u, 0x12345678u}), coverage0{1, 0.5f, 1};
    const std::vector<float> id1 = ids({0x40400003u, 0x40000002u, 0}), coverage1{0, 0.5f, 0};
    matches.see({{"crypto.id0", id0.data()},
                 {"crypto.coverage0", coverage0.data()},
                 {"crypto.id1", id1.data()},
                 {"crypto.coverage1", coverage1.data()}},
                3);
    EXPECT_EQ(matches.warnings(), (Lines{"scene.toml:7: layer \"c\": no pixel has the Cryptomatte object \"Sky\"; the "
                                         "frame has #12345678, Rock, Wall",
                                         "scene.toml:7: layer \"d\": no pixel has the Cryptomatte object "
                                         "\"#40800004\"; the frame has #12345678, Rock, Wall"}));
}

TEST(MaskMatches, TellOfPixelsWhoseFrontNobodyKnows) {
    MaskMatches matches(scene_of({on_name("a", "Rock")}));
    matches.begin(frame());
    const std::vector<float> front{std::bit_cast<float>(0x3f800001u), 0, -0.0f, -0.0f}, id(4, front[0]), all(4, 1);
    matches.see({{"crypto.front", front.data()}, {"crypto.id0", id.data()}, {"crypto.coverage0", all.data()}}, 2);
    EXPECT_EQ(matches.warnings(), Lines{}) << "0 is background";
    matches.see({{"crypto.front", front.data()}, {"crypto.id0", id.data()}, {"crypto.coverage0", all.data()}}, 4);
    ASSERT_EQ(matches.warnings().size(), 1u);
    EXPECT_EQ(matches.warnings()[0].find("Cryptomatte: 33.3% of the pixels show several objects"), 0u)
        << matches.warnings()[0];
}

TEST(MaskMatches, NameTheFirstRowOfADecal) {
    std::vector<Projector> rows(5);
    rows[1].object = 7, rows[1].line = 3;
    rows[2].object = 7, rows[2].line = 4;
    rows[3].object = 1, rows[3].line = 5;
    rows[4].cryptomatte = "Sky", rows[4].line = 6;
    MaskMatches matches(scene_of({table(rows)}));
    matches.begin(frame());
    see_objects(matches, {1, 2});
    EXPECT_EQ(matches.warnings(),
              (Lines{"scene.toml:7: layer \"wear\": no pixel has object 7 (wear.csv:3); the frame has 1, 2; no pixel "
                     "has the Cryptomatte object \"Sky\" (wear.csv:6); the frame has nothing"}));
}

TEST(MaskMatches, AreOfAllFramesAndNotOfInvertedMasks) {
    MaskMatches matches(scene_of({on_object("a", 1), on_object("b", 2), on_object("c", 3, true)}));
    for (const float object : {1.0f, 2.0f}) {
        matches.begin(frame());
        see_objects(matches, {object});
    }
    EXPECT_EQ(matches.warnings(), Lines{});
}

}  // namespace
}  // namespace wrinkle
