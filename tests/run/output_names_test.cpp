#include "run/output_names.h"

#include <gtest/gtest.h>

namespace wrinkle {
namespace {

using Files = std::vector<std::filesystem::path>;

Scene relit(const std::string& name) {
    Scene scene;
    scene.lighting.relight = Relight::ratio;
    scene.output.name = name;
    return scene;
}

TEST(OutputNames, ByThemselves) {
    EXPECT_EQ(OutputNames(relit(""), "out", {}).all(),
              (Files{"out/normal.exr", "out/lit.exr", "out/normal.png", "out/lit.png", "out/before.png"}));
    EXPECT_EQ(OutputNames(relit(""), "out", 7).exr("lit"), "out/lit.0007.exr");
    EXPECT_EQ(OutputNames(Scene{}, "out", {}).all(), (Files{"out/normal.exr", "out/normal.png"}));
}

TEST(OutputNames, OneFileOrSeveral) {
    const OutputNames single(relit("bump.%03d.exr"), "out", 7), several(relit("a_<picture>.$F4.exr"), "out", 7);
    EXPECT_TRUE(single.is_single());
    EXPECT_EQ(single.all(),
              (Files{"out/bump.007.exr", "out/normal.0007.png", "out/lit.0007.png", "out/before.0007.png"}));
    EXPECT_FALSE(several.is_single());
    EXPECT_EQ(several.exr("lit"), "out/a_lit.0007.exr");
    EXPECT_EQ(several.png("before"), "out/a_before.0007.png");
}

TEST(OutputNames, PicturesThatAreWanted) {
    Scene scene = relit("");
    scene.output.pictures = {"lit"};
    EXPECT_EQ(OutputNames(scene, "out", {}).all(), (Files{"out/normal.exr", "out/lit.exr", "out/lit.png"}));
    scene.output.png = 0;
    EXPECT_EQ(OutputNames(scene, "out", {}).all(), (Files{"out/normal.exr", "out/lit.exr"}));
}

}  // namespace
}  // namespace wrinkle
