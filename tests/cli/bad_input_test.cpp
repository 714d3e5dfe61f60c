// Bad input: the exit code is not 0, the message names what is wrong, and nothing is written.
#include <nlohmann/json.hpp>

#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

const std::string look = "eye = [0, -6, 4]\ntarget = [0, 0, 0]\nup = [0, 0, 1]\nfov = 40";

/// Runs the scene of `place`; expects it to fail and to leave nothing behind.
void expect_refused(const Workplace& place, const std::vector<std::string>& parts) {
    expect_failed(place.run("run scene.toml"), parts);
    EXPECT_FALSE(fs::exists(place / "out")) << "something was written";
}

std::string on(const char* kind, const std::string& rest) {
    return fmt::format("[[layer]]\nname = \"weave\"\nkind = \"{}\"\n{}\n", kind, rest);
}

TEST(BadGBuffer, MissingEmptyTruncatedOrNoImage) {
    const Workplace place;
    place.write_scene(tilt, "frame.exr", look);
    expect_refused(place, {"frame.exr"});
    write_text(place / "frame.exr", "");
    expect_refused(place, {"frame.exr", "empty"});
    write_text(place / "frame.exr", "this is no picture, only text");
    expect_refused(place, {"frame.exr"});
    const std::string good = read_text(data_folder / "gbuffer/small.exr");
    for (const std::size_t size : {good.size() / 200, good.size() / 2, good.size() - 9}) {
        write_text(place / "frame.exr", good.substr(0, size));
        place.write_scene(tilt, "frame.exr", look);
        const Ran ran = place.run("run scene.toml");
        expect_failed(ran, {"frame.exr"});
        EXPECT_TRUE(place.files("out").empty()) << "something was written from " << size << " bytes";
    }
    fs::remove(place / "frame.exr");
    fs::create_directory(place / "frame.exr");
    expect_failed(place.run("run scene.toml"), {"frame.exr"});
}

TEST(BadGBuffer, LacksAChannelThatALayerNeeds) {
    const Workplace place;
    write_exr(place / "frame.exr", 8, 6, {"Depth.Z", "Normal.X", "Normal.Y", "Normal.Z"}, [](int c, int, int) {
        return c == 0 ? 5.0f : c == 3 ? 1.0f : 0.0f;
    });
    place.write_scene(on("normal_map", "texture = \"" + Workplace::data_file("textures/weave_normal.png") + "\""),
                      "frame.exr", look);
    expect_refused(place, {"scene.toml:", "weave", "uv.u", "depth", "normal.x"});
    place.write_scene(tilt + "mask = { object = 3 }", "frame.exr", look);
    expect_refused(place, {"tilt", "object", "depth"});
    place.write_scene(tilt + "mask = { channel = \"dirt\" }", "frame.exr", look);
    expect_refused(place, {"tilt", "dirt"});
    place.write_scene(tilt + "[lighting]\nrelight = \"ratio\"\nambient = [1, 1, 1]\n", "frame.exr", look);
    expect_refused(place, {"ratio", "beauty.r"});
    write_exr(place / "flat.exr", 8, 6, {"Normal.X", "Normal.Y", "Normal.Z"});
    place.write_scene(tilt, "flat.exr", look);
    expect_refused(place, {"flat.exr: geometry, by a depth or a position pass, needs depth; the G-buffer has normal.x",
                           "[gbuffer] roles"});
    place.write_scene(tilt, "frame.exr", look);
    EXPECT_EQ(place.run("run scene.toml").code, 0) << "enough for a constant";
}

TEST(BadCamera, DoesNotFitTheFrame) {
    const Workplace place;
    auto camera = nlohmann::json::parse(read_text(data_folder / "gbuffer/small.camera.json"));
    place.write_scene(tilt, Workplace::data_file("gbuffer/small.exr"), "file = \"cam.json\"");
    expect_refused(place, {"cam.json"});
    write_text(place / "cam.json", "{ \"view\": [");
    expect_refused(place, {"cam.json"});
    camera["view"][0][3] = camera["view"][0][3].get<double>() + 0.5;
    write_text(place / "cam.json", camera.dump());
    expect_refused(place, {"cam.json", "pixel", "small.exr"});
}

TEST(BadScene, UnknownCryptomatteNamesListTheKnownOnes) {
    const Workplace place;
    place.write_scene(tilt + "mask = { cryptomatte = \"Susanne\" }");
    expect_refused(place, {"tilt", "Susanne", "Ground", "Rock", "Suzanne", "Torus", "Wall"});
    fs::create_directory(place / "tables");
    write_text(place / "tables/wear.csv", "x,y,z,cryptomatte\n0,0,0,Rock\n0,0,0,Susanne\n");
    place.write_scene(on("decals", "file = \"tables/wear.csv\"\ntextures = [{ file = \"" +
                                       Workplace::data_file("textures/seal_height.png") + "\" }]"));
    expect_refused(place, {"scene.toml:", "tables/wear.csv:3: ", "\"Susanne\"", "nearest: \"Suzanne\""});
    write_text(place / "tables/wear.csv", "x,y,z\n0,0,0,0\n");
    expect_refused(place, {"scene.toml:", "\n", "tables/wear.csv:2: has 4 fields"});
}

TEST(BadScene, NumbersKeysAndFiles) {
    const Workplace place;
    place.write_scene(on("constant", "gradient = [1, 0, 0]\nscale = inf"));
    expect_refused(place, {"scene.toml:", "scale", "inf"});
    place.write_scene(on("constant", "gradient = [1, nan, 0]"));
    expect_refused(place, {"scene.toml:", "gradient"});
    place.write_scene(on("noise", "frequenzy = 4"));
    expect_refused(place, {"scene.toml:", "frequenzy", "frequency"});
    write_text(place / "scene.toml", "[gbuffer\nfile = 3");
    expect_refused(place, {"scene.toml:"});
    fs::remove(place / "scene.toml");
    expect_refused(place, {"scene.toml"});
    expect_failed(place.run("run '" + Workplace::data_file("gbuffer/small.exr") + "'"),
                  {"small.exr: is no text", "wrinkle info"});
    fs::create_directory(place / "shots");
    place.write_scene(on("noise", "frequenzy = 4"), Workplace::data_file("gbuffer/small.exr"), look, "shots/a.toml");
    expect_failed(place.run("run shots/a.toml"), {"wrinkle: shots/a.toml:"});
}

TEST(BadTexture, ChannelsAndTexels) {
    const Workplace place;
    const auto expect_texture_refused = [&](const char* kind, const std::string& file,
                                            const std::vector<std::string>& parts) {
        place.write_scene(on(kind, "texture = \"" + file + "\""));
        expect_refused(place, parts);
    };
    write_exr(place / "two.exr", 4, 4, {"R", "G"});
    write_exr(place / "one.exr", 4, 4, {"Y"});
    write_exr(place / "broken.exr", 4, 4, {"R", "G", "B"}, [](int c, int x, int y) {
        return c == 0 && x == 2 && y == 1 ? std::numeric_limits<float>::quiet_NaN() : 0.5f;
    });
    write_text(place / "empty.png", "");
    expect_texture_refused("height_map", "two.exr", {"two.exr", "\"R\", \"G\" could be the heights"});
    expect_texture_refused("normal_map", "one.exr", {"one.exr", "1 channel"});
    expect_texture_refused("height_map", "broken.exr", {"broken.exr", "NaN", "(2, 1)"});
    expect_texture_refused("triplanar", "empty.png", {"empty.png"});
    const std::string whole = read_text(data_folder / "textures/weave_normal.png");
    write_text(place / "cut.png", whole.substr(0, whole.size() / 2));
    expect_texture_refused("normal_map", "cut.png", {"cut.png: the PNG is truncated"});
    expect_texture_refused("height_map", "nowhere.png", {"nowhere.png"});
    place.write_scene(tilt + "mask = { texture = \"broken.exr\" }\n" + on("height_map", "texture = \"two.exr\""));
    expect_refused(place, {"scene.toml:", "layer \"tilt\": ", "broken.exr", "NaN"});
    write_text(place / "wear.csv", "x,y,z,s1\n0,0,0,0.5\n");
    place.write_scene(on("decals", "file = \"wear.csv\"\ntextures = [{ file = \"cut.png\" }]"));
    expect_refused(place, {"scene.toml:", "layer \"weave\": ", "cut.png: the PNG is truncated"});
}

TEST(BadOutput, FolderCannotBeMadeOrWritten) {
    const Workplace place;
    place.write_scene(tilt);
    write_text(place / "file", "in the way");
    expect_failed(place.run("run scene.toml -o file"), {"file"});
    expect_failed(place.run("run scene.toml -o file/out"), {"file/out"});
    EXPECT_EQ(read_text(place / "file"), "in the way");
    fs::create_directories(place / "out/normal.exr");
    expect_failed(place.run("run scene.toml -o out"), {"out/normal.exr", "folder"});
    EXPECT_EQ(place.files("out"), std::vector<std::string>{"normal.exr"});
}

TEST(BadMachine, WithoutOpenCL) {
    const Workplace place;
    place.write_scene(tilt);
    for (const char* arguments : {"run scene.toml", "devices"})
        expect_failed(place.run(arguments, "OCL_ICD_VENDORS=/nonexistent"), {"OpenCL", "pocl-opencl-icd"});
    EXPECT_FALSE(fs::exists(place / "out"));
    EXPECT_EQ(place.run("explain scene.toml", "OCL_ICD_VENDORS=/nonexistent").code, 0) << "needs no device";
    expect_failed(place.run("run scene.toml --device toaster"), {"toaster", "0: "});
}

}  // namespace
}  // namespace wrinkle::test
