// What goes wrong with files and devices reaches callers of the public headers as Error, in words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "run/open_frame.h"
#include "tests/device/test_device.h"
#include "tests/io/files.h"
#include "wrinkle/error.h"
#include "wrinkle/functions.h"
#include "wrinkle/passes.h"

namespace wrinkle::test {
namespace {

namespace fs = std::filesystem;

/// The text of an Error that does not read like an exception of a library; anything else fails the test.
std::string error_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        const std::string text = error.what();
        for (const char* raw : {"std::", "filesystem error", "json.exception", "what()"})
            EXPECT_EQ(text.find(raw), std::string::npos) << text;
        return text;
    } catch (const std::exception& other) {
        ADD_FAILURE() << "no Error: " << other.what();
        return "";
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

/// File names that the system itself refuses: links in a circle, longer than any, within a file, a folder.
std::vector<fs::path> impossible_files(const TempFolder& folder, const std::string& extension) {
    fs::create_symlink("circle" + extension, folder / ("circle" + extension));
    std::ofstream(folder / "file") << "x";
    fs::create_directory(folder / ("folder" + extension));
    return {folder / ("circle" + extension), folder / (std::string(300, 'x') + extension),
            folder / ("file/below" + extension), folder / ("folder" + extension)};
}

TEST(OnlyErrorLeaves, ScenesAndTables) {
    const TempFolder folder;
    for (const fs::path& file : impossible_files(folder, ".toml")) {
        EXPECT_NE(error_of([&] { load_scene(file); }), "") << file;
        EXPECT_NE(error_of([&] { load_decals(file, 1); }), "") << file;
    }
    const TempFolder other;
    for (const fs::path& file : impossible_files(other, ".csv"))
        EXPECT_NE(error_of([&] { load_decals(file, 1); }), "") << file;
    EXPECT_NE(error_of([&] { save_decals(folder / "file/below.csv", {}); }), "");
    EXPECT_NE(error_of([&] { save_decals(folder / "folder.toml", {}); }), "");
}

TEST(OnlyErrorLeaves, TexturesOfPassesAndFunctions) {
    const TempFolder folder;
    const Camera camera = Camera::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1, 1);
    const Frame frame{{4, 4}, camera, {"depth", "normal.x", "normal.y", "normal.z"}};
    const std::vector<float> column(4);
    for (const char* extension : {".png", ".exr", ".tif"}) {
        const TempFolder here;
        for (const fs::path& file : impossible_files(here, extension)) {
            Scene scene;
            scene.layers.resize(1);
            scene.layers[0].name = "map";
            scene.layers[0].bump = HeightMapLayer{.texture = {.file = file}, .uv = {.source = UvSource::planar}};
            EXPECT_NE(error_of([&] { evaluate(test_device(), scene, frame); }), "") << file;
        }
    }
    for (const fs::path& file : impossible_files(folder, ".vdb")) {
        Scene scene;
        scene.layers.resize(1);
        scene.layers[0].name = "fog";
        VolumeLayer fog;
        fog.file = file;
        scene.layers[0].bump = fog;
        EXPECT_NE(error_of([&] { evaluate(test_device(), scene, frame); }), "") << file;
        EXPECT_NE(error_of([&] {
                      evaluate_function(test_device(), function("volume_trilinear"),
                                        Columns{{"p.x", column}, {"p.y", column}, {"p.z", column}}, {},
                                        {.settings = {{"volume", file}}});
                  }),
                  "")
            << file;
    }
}

TEST(OnlyErrorLeaves, CamerasThatAreNoJson) {
    const TempFolder folder;
    Scene scene;
    scene.gbuffer.file = fs::path(WRINKLE_SOURCE_DIR) / "data/gbuffer/small.exr";
    scene.camera.file = folder / "camera.json";
    for (const char* text : {"", "{", "[]", "{\"view\": 1e999}", "{\"view\": [[1]], \"proj\": null}", "\xff\xfe"}) {
        std::ofstream(scene.camera.file) << text;
        EXPECT_NE(error_of([&] { describe_frame(scene); }).find("camera.json"), std::string::npos) << text;
    }
}

TEST(OnlyErrorLeaves, FunctionsAndQueues) {
    EXPECT_NE(error_of([] { Device::adopt({}, {}); }), "");
    EXPECT_NE(error_of([] { function("resolv"); }).find("resolve"), std::string::npos);
    EXPECT_NE(error_of([] { inverse({}); }), "");
    const std::vector<float> column(4);
    FunctionOptions odd;
    odd.lanes = 3;
    EXPECT_NE(error_of([&] {
                  evaluate_function(test_device(), function("resolve"),
                                    Columns{{"n.x", column},
                                            {"n.y", column},
                                            {"n.z", column},
                                            {"g.x", column},
                                            {"g.y", column},
                                            {"g.z", column}},
                                    {}, odd);
              }).find("1, 4, 8 or 16 lanes, not 3"),
              std::string::npos);
}

TEST(OnlyErrorLeaves, OutOfMemory) {
    Scene scene;
    scene.output.marked = true;
    const Camera camera = Camera::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1, 1);
    const Frame frame{{4, 4}, camera, {"depth", "normal.x", "normal.y", "normal.z"}};
    Frame huge = frame;
    huge.size = {1u << 31, 1u << 31};
    PassOptions split;
    split.split = true;
    Layer& tilt = scene.layers.emplace_back();
    tilt.name = "tilt";
    tilt.bump = ConstantLayer{{0.3, 0, 0}};
    EXPECT_NE(error_of([&] { evaluate(test_device(), scene, huge, split); }), "") << "a frame of 2^62 pixels in memory";
}

}  // namespace
}  // namespace wrinkle::test
