#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "wrinkle/error.h"
#include "wrinkle/scene.h"

namespace wrinkle {

inline constexpr double degree = std::numbers::pi / 180;

inline void expect_near(const Vec3& found, const Vec3& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-15);
}

/// A folder of its own for each test, with the files that the scenes of these tests name.
class SceneFolder : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("wrinkle_scene_" + std::to_string(getpid()) + "_" + info->test_suite_name() + "_" + info->name());
        std::filesystem::create_directories(folder_ / "textures");
        for (const char* name : {"frame.exr", "camera.json", "textures/wall.png"})
            write(name, "not read by load_scene");
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }

    /// Loads a scene from a file courtyard.toml with this text.
    Scene load(const std::string& text) const { return load_scene(write("courtyard.toml", text)); }

    /// Loads a scene of the four lines that every scene needs, followed by `text`, whose first line is line 5.
    Scene load_with(const std::string& text) const { return load(frame_ + text); }

    /// The problems of a scene, a string for each, without the folder in front of the scene's name.
    std::vector<std::string> problems(const std::string& text) const {
        std::vector<std::string> out;
        try {
            load(text);
        } catch (const Error& error) {
            std::istringstream lines(error.what());
            const std::string here = (folder_ / "").string();
            EXPECT_EQ(std::string(error.what()).rfind(here + "courtyard.toml:", 0), 0u) << error.what();
            for (std::string line; std::getline(lines, line);)
                out.push_back(line.rfind(here, 0) == 0 ? line.substr(here.size()) : line);
        }
        return out;
    }

    /// Expects that a scene has exactly one problem, at `line`, whose message contains all of `parts`.
    void expect_problem(const std::string& text, int line, const std::vector<std::string>& parts) const {
        const std::vector<std::string> found = problems(text);
        ASSERT_EQ(found.size(), 1u) << text << testing::PrintToString(found);
        const std::string location = "courtyard.toml:" + std::to_string(line) + ": ";
        EXPECT_EQ(found[0].substr(0, location.size()), location) << found[0];
        for (const std::string& part : parts)
            EXPECT_NE(found[0].find(part), std::string::npos) << part << "\n" << found[0];
    }

    /// The same for a text that follows the four lines.
    void expect_problem_with(const std::string& text, int line, const std::vector<std::string>& parts) const {
        expect_problem(frame_ + text, line, parts);
    }

    const std::string frame_ = "[gbuffer]\nfile = \"frame.exr\"\n[camera]\nfrom = \"exr\"\n";
    std::filesystem::path folder_;
};

}  // namespace wrinkle
