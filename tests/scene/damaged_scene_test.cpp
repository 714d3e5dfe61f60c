#include <random>

#include "tests/scene/full_scene.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using DamagedScene = SceneFolder;

/// Loads a damaged scene. It may load or throw Error; any other exception or a crash is a failure.
void survives(const std::filesystem::path& file) {
    try {
        load_scene(file);
    } catch (const Error& error) { EXPECT_NE(std::string(error.what()).find("courtyard.toml"), std::string::npos); }
}

TEST_F(DamagedScene, CutAnywhereItParsesOrThrowsError) {
    const std::string text = full_scene;
    for (std::size_t length = 0; length < text.size(); ++length)
        survives(write("courtyard.toml", text.substr(0, length)));
}

TEST_F(DamagedScene, DamagedAnywhereItParsesOrThrowsError) {
    const std::string text = full_scene;
    const std::string bytes = "[]{}=\"'#.,-+ \n\r\t0159aez_\\\x01\x7f\xc3\xff";
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i) {
        std::string damaged = text;
        for (int hits = 0; hits <= i % 3; ++hits) damaged[random() % damaged.size()] = bytes[random() % bytes.size()];
        if (i % 5 == 0) damaged.erase(random() % damaged.size(), 1 + random() % 30);
        survives(write("courtyard.toml", damaged));
    }
}

TEST_F(DamagedScene, LettersBeyondAsciiAreToldOfOutsideStrings) {
    for (const char* letter : {"\u00e9", "\u03a5", "\u0416", "\u5c71", "\U0001f3a8"})
        for (const char* around : {"{} = 1", "scale = [2, {}]", "scale = 1{}", "[{}]", "a = \"b\" {}"}) {
            const std::string text = "# 1\n" + fmt::format(fmt::runtime(around), letter) + "\n";
            try {
                load_scene(write("courtyard.toml", text));
                ADD_FAILURE() << "read: " << text;
            } catch (const Error& error) {
                EXPECT_NE(std::string(error.what()).find("courtyard.toml:2"), std::string::npos) << error.what();
            }
        }
}

}  // namespace
}  // namespace wrinkle
