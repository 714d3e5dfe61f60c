#include <fmt/format.h>

#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using VolumeScene = SceneFolder;

std::string volume(const std::string& rest) {
    return "[[layer]]\nkind = \"volume\"\nvolume = \"textures/wall.png\"\n" + rest;
}

TEST_F(VolumeScene, EveryKey) {
    const Scene scene =
        load_with(volume("grid = \"density\"\nfilter = \"smooth\"\nremap = \"wave\"\nrange = [0.5, 0.25]\nscale = 2\n"
                         "transform = [[0, -2, 0, 1], [2, 0, 0, 2], [0, 0, 2, 3], [0, 0, 0, 1]]\n"));
    const auto& layer = std::get<VolumeLayer>(scene.layers.at(0).bump);
    EXPECT_EQ(layer.file, folder_ / "textures/wall.png");
    EXPECT_EQ(layer.grid, "density");
    EXPECT_EQ(layer.filter, VolumeFilter::smooth);
    EXPECT_EQ(layer.remap, Remap::wave);
    EXPECT_EQ(layer.range, (std::array<double, 2>{0.5, 0.25}));
    EXPECT_EQ(layer.transform, (Mat4{{{0, -2, 0, 1}, {2, 0, 0, 2}, {0, 0, 2, 3}, {0, 0, 0, 1}}}));
    EXPECT_EQ(scene.layers[0].scale, 2);
}

TEST_F(VolumeScene, FootprintChoosesItsLevels) {
    EXPECT_FALSE(load_with(volume("footprint = false\n")).layers.at(0).footprint);
    EXPECT_TRUE(load_with(volume("")).layers.at(0).footprint);
}

TEST_F(VolumeScene, Defaults) {
    const Scene scene = load_with(volume(""));
    const auto& layer = std::get<VolumeLayer>(scene.layers.at(0).bump);
    EXPECT_TRUE(layer.grid.empty());
    EXPECT_EQ(layer.filter, VolumeFilter::linear);
    EXPECT_EQ(layer.remap, Remap::none);
    EXPECT_EQ(layer.transform[1][1], 1);
}

TEST_F(VolumeScene, BadValues) {
    expect_problem_with("[[layer]]\nkind = \"volume\"\n", 5, {"needs the key \"volume\""});
    expect_problem_with("[[layer]]\nkind = \"volume\"\nvolume = \"fog.vdb\"\n", 7, {"there is no file", "fog.vdb"});
    expect_problem_with(volume("filter = \"cubic\"\n"), 8, {"is \"cubic\"; allowed: \"linear\", \"smooth\""});
    expect_problem_with(volume("remap = \"waves\"\n"), 8, {"did you mean \"wave\"?"});
    expect_problem_with(volume("remap = \"ramp\"\nrange = [1, 1]\n"), 9, {"must be two different numbers"});
    expect_problem_with(volume("range = [0, 2]\n"), 8, {"\"range\"", "remap = "});
    expect_problem_with(volume("transform = [[1, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0], [0, 0, 0, 1]]\n"), 8,
                        {"\"transform\"", "cannot be inverted"});
    expect_problem_with(volume("transform = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]\n"), 8,
                        {"must be affine"});
    expect_problem_with(volume("footprint = 2\n"), 8, {"\"footprint\"", "true or false"});
    for (const char* kind : {"\"constant\"\ngradient = [1, 0, 0]", "\"height_channel\"\nchannel = \"dust\""})
        expect_problem_with(fmt::format("[[layer]]\nkind = {}\nfootprint = true\n", kind), 8, {"no levels of detail"});
}

}  // namespace
}  // namespace wrinkle
