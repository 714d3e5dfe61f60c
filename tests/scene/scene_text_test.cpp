// Numbers in a scene's text: found, and changed without a trace.
#include "scene/scene_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wrinkle::scene {
namespace {

const std::string kScene =
    "# Müller's scene: ä = 1\n"
    "[gbuffer]\n"
    "file = 'a.exr'   # frame 7\n"
    "\n"
    "[[layer]]\n"
    "name = \"Bögen\"\n"
    "kind = \"noise\"\n"
    "octaves = 4                    # detail\n"
    "'ä' = { scale = [ 1_000, -2.5e-3 ] }   # \"quoted\" 3\n"
    "mask = { object = 5 }\n"
    "\n"
    "  [[layer]]\r\n"
    "kind = \"constant\"\n"
    "gradient = [\n"
    "  0.25,  # x\n"
    "  0,\n"
    "  +1 ]\n"
    "matrix = [[1, 0], [0, 1]]\n"
    "[lighting]\n"
    "exposure = 0x10\n"
    "f0 = 0.04";

TEST(SceneText, FindsNumbersThatAreKnobs) {
    const auto numbers = numbers_in(kScene);
    std::vector<std::string> ids;
    for (const SceneNumber& number : numbers) ids.push_back(number.id);
    const std::vector<std::string> expected{"layer.0.octaves",    "layer.0.ä.scale.0",  "layer.0.ä.scale.1",
                                            "layer.1.gradient.0", "layer.1.gradient.1", "layer.1.gradient.2",
                                            "lighting.f0"};
    ASSERT_EQ(ids, expected);
    EXPECT_EQ(numbers[0].group, "Bögen");
    EXPECT_EQ(numbers[0].line, 8u);
    EXPECT_TRUE(numbers[0].whole);
    EXPECT_EQ(numbers[1].value, 1000);
    EXPECT_EQ(numbers[2].name, "ä.scale y");
    EXPECT_EQ(numbers[2].value, -2.5e-3);
    EXPECT_EQ(numbers[3].group, "constant 2");
    EXPECT_EQ(kScene.substr(numbers[2].begin, numbers[2].size), "-2.5e-3");
}

TEST(SceneText, ChangesNumbersAndNothingElse) {
    const std::string changed = with_numbers(kScene, {{"layer.0.octaves", 5},
                                                      {"layer.0.ä.scale.1", 0.1},
                                                      {"layer.1.gradient.1", 2},
                                                      {"lighting.f0", 0.04},
                                                      {"layer.7.scale", 3}});
    std::string expected = kScene;
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"octaves = 4", "octaves = 5"},
                                   {"-2.5e-3 ]", "0.1 ]"},
                                   {"  0,\n", "  2.0,\n"}})
        expected.replace(expected.find(from), from.size(), to);
    EXPECT_EQ(changed, expected);
    EXPECT_EQ(with_numbers(kScene, {}), kScene);
}

TEST(SceneText, TellsFramesApartByTheirTables) {
    EXPECT_EQ(frame_tables(kScene), frame_tables(with_numbers(kScene, {{"lighting.f0", 0.1}})));
    EXPECT_NE(frame_tables(kScene), frame_tables("[gbuffer]\nfile = 'b.exr'"));
}

}  // namespace
}  // namespace wrinkle::scene
