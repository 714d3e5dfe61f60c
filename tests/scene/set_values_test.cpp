#include "scene/set_values.h"

#include "layers/kinds.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

class SetValues : public SceneFolder {
protected:
    Scene with(const std::vector<std::string>& settings) const {
        const auto file = write("courtyard.toml", frame_ +
                                                      "[[layer]]\nname = \"dents\"\nkind = \"noise\"\nscale = 1\n"
                                                      "[[layer]]\nkind = \"height_map\"\n"
                                                      "texture = \"textures/wall.png\"\nuv = { scale = 2 }\n"
                                                      "[lighting]\nrelight = \"lit\"\n"
                                                      "[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n");
        return load_scene_file(file, {.set = settings}).scene;
    }
    void expect_refused(const std::string& setting, const std::vector<std::string>& parts) const {
        std::string why;
        try {
            with({setting});
        } catch (const Error& error) { why = error.what(); }
        for (const std::string& part : parts) EXPECT_NE(why.find(part), std::string::npos) << part << "\n" << why;
    }
};

TEST_F(SetValues, ReplacesAndAdds) {
    const Scene scene = with({"layer.dents.scale=0.25", "layer.2.uv.scale = [3, 4]", "light.1.intensity=7",
                              "layer.'height_map 2'.blend=subtract", "output.half=true", "lighting.exposure=-1"});
    EXPECT_EQ(scene.layers[0].scale, 0.25);
    EXPECT_EQ(scene.layers[1].blend, Blend::subtract);
    EXPECT_EQ(scene.lighting.lights[0].intensity, 7);
    EXPECT_TRUE(scene.output.half);
    EXPECT_EQ(scene.lighting.exposure, -1);
}

TEST_F(SetValues, WhatItMeansIsCheckedAsInAFile) {
    expect_refused("layer.dents.scael=1", {"unknown key \"scael\"", "\"scale\"?", "--set layer.dents.scael"});
    expect_refused("layer.dents.octaves=0", {"\"octaves\"", "from 1 to 16; found 0", "--set"});
    expect_refused("layer.dents.scale=1.2.3", {"must be a number; found the text \"1.2.3\""});
}

TEST_F(SetValues, WhatIsNotThereIsRefused) {
    expect_refused("layer.dens.scale=1", {"there is no layer \"dens\"", "\"dents\", \"height_map 2\""});
    expect_refused("layer.dents=1", {"names no key of layer \"dents\""});
    expect_refused("layer.dents.scale.x=1", {"\"scale\" is no table but 1"});
    expect_refused("layer.dents.scale", {"expected KEY=VALUE"});
    expect_refused("=1", {"--set =1"});
}

TEST_F(SetValues, TextOfTheSceneTellsWhatWasSet) {
    const auto file = write("courtyard.toml", frame_);
    const std::string plain = load_scene_file(file, {}).text;
    EXPECT_EQ(load_scene_file(write("courtyard.toml", "# changed\n" + frame_), {}).text, plain);
    EXPECT_NE(load_scene_file(file, {.set = {"output.half=true"}}).text, plain);
}

TEST_F(SetValues, NumbersOfFramesAndVariablesAreFilledIntoNames) {
    const std::string layer = "[[layer]]\nkind = \"height_map\"\ntexture = \"";
    write("textures/wall.0007.png", "");
    const auto file = write("courtyard.toml", frame_ + layer + "textures/wall.####.png\"\n");
    const auto loaded = load_scene_file(file, {.frame = 7});
    EXPECT_EQ(loaded.files, std::vector{folder_ / "textures/wall.0007.png"});
    EXPECT_EQ(loaded.frame_files, std::vector{folder_ / "textures/wall.####.png"});
    EXPECT_THROW(load_scene_file(file, {.frame = 8}), Error);
    ::setenv("WRINKLE_TEST_TEXTURES", (folder_ / "textures").c_str(), 1);
    EXPECT_EQ(load_scene_file(write("c.toml", frame_ + layer + "$WRINKLE_TEST_TEXTURES/wall.png\"\n"), {}).files,
              std::vector{folder_ / "textures/wall.png"});
    ::unsetenv("WRINKLE_TEST_TEXTURES");
    expect_problem_with(layer + "$WRINKLE_TEST_TEXTURES/wall.png\"\n", 7, {"\"texture\"", "none of that name is set"});
}

TEST_F(SetValues, OutputsAreNamedWithoutFolders) {
    const auto output = [&](const std::string& text) { return load_with("[output]\n" + text + "\n").output; };
    EXPECT_EQ(output("name = \"bump.####.exr\"").name, "bump.####.exr");
    EXPECT_EQ(output("png = false").png, 0);
    EXPECT_EQ(output("png = true").png, 8);
    EXPECT_EQ(output("png = 16\npictures = [\"lit\"]\ncompression = \"dwaa\"").png, 16);
    for (const char* name : {"../bump.exr", "/tmp/bump.exr", "a/b.exr", "bump.png", "bump", ".exr"})
        expect_problem_with("[output]\nname = \"" + std::string(name) + "\"\n", 6, {"without its folder"});
    expect_problem_with("[output]\npng = 9\n", 6, {"false, 8 or 16"});
    expect_problem_with("[output]\npictures = [\"depth\"]\n", 6, {"\"depth\"", "\"normal\", \"lit\", \"before\""});
    expect_problem_with("[output]\ncompression = \"gzip\"\n", 6, {"\"zips\""});
}

}  // namespace
}  // namespace wrinkle
