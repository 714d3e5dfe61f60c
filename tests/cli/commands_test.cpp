// What the program prints and writes when all is well.
#include <nlohmann/json.hpp>

#include "io/gbuffer_reader.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

using Names = std::vector<std::string>;

TEST(Commands, HelpAndVersion) {
    const Workplace place;
    const Ran help = place.run("--help");
    EXPECT_EQ(help.code, 0);
    expect_mentions(help.out, {"run", "info", "explain", "figures", "devices", "Examples"});
    const Ran version = place.run("--version");
    EXPECT_EQ(version.code, 0);
    EXPECT_TRUE(std::regex_match(version.out, std::regex("wrinkle \\d+\\.\\d+\\.\\d+\n"))) << version.out;
    for (const char* command : {"run", "info", "explain", "figures", "devices"})
        EXPECT_EQ(place.run(std::string(command) + " --help").code, 0) << command;
    EXPECT_EQ(place.run("help").out, help.out);
    EXPECT_EQ(place.run("version").out, version.out);
    EXPECT_EQ(place.run("help run").out, place.run("run --help").out);
    const Ran bare = place.run("");
    EXPECT_EQ(bare.code, 2);
    EXPECT_EQ(bare.err, help.out);
    for (const auto& [arguments, named] :
         std::map<std::string, std::string>{{"paint", "paint"}, {"run", "SCENE"}, {"run a.toml --fast", "--fast"}}) {
        const Ran ran = place.run(arguments);
        EXPECT_EQ(ran.code, 2) << arguments;
        expect_failed(ran, {named, arguments.starts_with("run") ? "\"wrinkle run --help\"" : "\"wrinkle --help\""});
    }
    for (const char* malformed :
         {"run a.toml --frames abc", "run a.toml --frames 3,3", "run a.toml --repeat 0", "info a.exr --frame one"})
        EXPECT_EQ(place.run(malformed).code, 2) << malformed;
}

TEST(Commands, Devices) {
    const Workplace place;
    const auto list = nlohmann::json::parse(place.run("devices --json").out);
    ASSERT_FALSE(list.empty());
    EXPECT_GT(list[0].at("lanes").get<int>(), 0);
    expect_mentions(place.run("devices").out, {"0: " + list[0].at("name").get<std::string>(), "driver", "double"});
}

TEST(Commands, Info) {
    const Workplace place;
    const std::string file = Workplace::data_file("gbuffer/small.exr");
    const Ran text = place.run("info '" + file + "'");
    EXPECT_EQ(text.code, 0) << text.err;
    expect_mentions(text.out, {"120 x 68", "position", "Suzanne", "reproject", "normal_map"});
    const auto json = nlohmann::json::parse(place.run("info --json '" + file + "'").out);
    EXPECT_EQ(json.at("width"), 120);
    EXPECT_LT(json.at("camera").at("residual_pixels").at("median").get<double>(), 0.1);

    place.write_scene("", file + "\"\nroles = { object = \"none\" }  # ");
    const Ran scene = place.run("info scene.toml");
    EXPECT_EQ(scene.code, 0) << scene.err;
    expect_mentions(scene.out, {"120 x 68", "reproject", "lacks object"});
    EXPECT_EQ(text.out.find("lacks object"), std::string::npos);
    fs::rename(place / "scene.toml", place / "SCENE.TOML");
    EXPECT_EQ(place.run("info SCENE.TOML").out, scene.out);
    fs::copy_file(data_folder / "gbuffer/small.exr", place / "shot#2.exr");
    expect_mentions(place.run("info 'shot#2.exr'").out, {"shot#2.exr: 120 x 68"});
}

TEST(Commands, Explain) {
    const Workplace place;
    place.write_scene(tilt + lit);
    const Ran text = place.run("explain scene.toml");
    EXPECT_EQ(text.code, 0) << text.err;
    expect_mentions(text.out, {"decode the G-buffer", "constant \"tilt\"", "resolve", "light", "write", "kernel void",
                               "ops/pixel", "bytes of planes"});
    EXPECT_EQ(place.run("explain --no-source scene.toml").out.find("kernel void"), std::string::npos);
    const Ran stored = place.run("explain --format normal=octahedral16 --format depth=half --json scene.toml");
    EXPECT_EQ(nlohmann::json::parse(stored.out).at("bytes_per_pixel").get<double>() + (12 - 4) + (4 - 2),
              nlohmann::json::parse(place.run("explain --json scene.toml").out).at("bytes_per_pixel").get<double>());
    expect_mentions(stored.out, {"WR_STORED_OCTAHEDRAL, 4, 4, 0, 2"});
    const Ran mistyped = place.run("explain --format normal=octahedral61 scene.toml");
    EXPECT_NE(mistyped.code, 0);
    expect_mentions(mistyped.err, {"\"octahedral61\"; did you mean \"octahedral16\"", "\"uint32\""});
    expect_mentions(place.run("explain --format normal scene.toml").err, {"NAME=ENCODING"});
    expect_mentions(place.run("explain --format normal=half --format normal.x=half scene.toml").err,
                    {"\"normal.x\" has a format already"});
    expect_mentions(place.run("explain --format normal=unorm8 scene.toml").out, {"-1.00000000f}"});
    expect_mentions(place.run("explain --full scene.toml").out, {"#line 1 \"vec.clh\""});
    const auto json = nlohmann::json::parse(place.run("explain --json scene.toml").out);
    EXPECT_EQ(json.at("sections").size(), 5u);
    EXPECT_EQ(json.at("sections")[1].at("title"), "constant \"tilt\"");
    EXPECT_EQ(text.err, "");
    place.write_scene(tilt, Workplace::data_file("gbuffer/small.exr"),
                      "eye = [0, -6, 4]\ntarget = [0, 0, 0]\nfov = 40");
    const Ran warned = place.run("explain scene.toml");
    EXPECT_EQ(warned.code, 0);
    expect_mentions(warned.err, {"wrinkle: warning: ", "small.exr", "pixels away"});
}

TEST(Commands, LanesAsAsked) {
    const Workplace place;
    place.write_scene(tilt);
    std::map<std::string, std::vector<unsigned char>> pictures;
    for (const char* lanes : {"1", "4", "8", "16"}) {
        const Ran ran = place.run(fmt::format("run scene.toml --json --lanes {0} -o out{0}", lanes));
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(nlohmann::json::parse(ran.out).at("lanes"), std::stoi(lanes));
        const auto planned =
            nlohmann::json::parse(place.run("explain scene.toml --json --lanes " + std::string(lanes)).out);
        EXPECT_EQ(planned.at("device").at("flags"), fmt::format("-cl-std=CL1.2 -D WR_LANES={}", lanes));
        pictures[lanes] = pixels_of(place / fmt::format("out{}/normal.png", lanes));
    }
    for (const auto& [lanes, picture] : pictures) EXPECT_EQ(picture, pictures["1"]) << lanes << ", to 16 bits";
    for (const char* lanes : {"0", "2", "5", "many"})
        for (const std::string command : {"run", "explain"})
            expect_failed(place.run(command + " scene.toml --lanes " + lanes),
                          {"--lanes", lanes, "expected 1, 4, 8 or 16"});
    const Ran text = place.run("explain scene.toml --no-source --device 0");
    expect_mentions(text.out, {" lanes: -cl-std=CL1.2 -D WR_LANES="});
    expect_failed(place.run("explain scene.toml --device nowhere"), {"nowhere", "no OpenCL device"});
    expect_mentions(place.run("run --help").out, {"--lanes", "1, 4, 8 or 16"});
}

TEST(Commands, RunWritesPictures) {
    const Workplace place;
    place.write_scene(tilt + lit);
    const Ran text = place.run("run scene.toml -o deep/out");
    ASSERT_EQ(text.code, 0) << text.err;
    EXPECT_EQ(place.files("deep/out"), (Names{"lit.exr", "lit.png", "normal.exr", "normal.png"}));
    expect_mentions(text.out, {"1 frame", "1 active layer", "kernels", "ns/pixel", "deep/out/normal.exr", "reproject"});

    const Ran json = place.run("run scene.toml -o out --json --repeat 3 --threads 1");
    const auto report = nlohmann::json::parse(json.out);
    EXPECT_EQ(report.at("pixels"), 120 * 68);
    EXPECT_EQ(report.at("files").size(), 4u);
    EXPECT_TRUE(report.at("cache_hit").get<bool>()) << "the run before built the same program";
    for (const std::string name : {"lit.png", "normal.png"})  // EXR files hold the date
        EXPECT_TRUE(read_text(place / ("out/" + name)) == read_text(place / ("deep/out/" + name))) << name;

    const Ran quiet = place.run("run scene.toml -o out --quiet");
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
    EXPECT_EQ(place.files("out").size(), 4u) << "no leftovers beside the pictures";
}

TEST(Commands, RunWarnsOfMasksThatNoPixelMatches) {
    const Workplace place;
    place.write_scene(tilt + "mask = { object = 77 }\n");
    const Ran told = place.run("run scene.toml");
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_EQ(told.err,
              "wrinkle: warning: scene.toml:5: layer \"tilt\": no pixel has object 77; the frame has 0, 1, 2, 3, 4, "
              "5\n");
    EXPECT_EQ(place.run("run scene.toml --quiet").err, "");
    const auto report = nlohmann::json::parse(place.run("run scene.toml --json").out);
    EXPECT_EQ(report["warnings"].size(), 1u);
    place.write_scene(tilt + "mask = { cryptomatte = \"#00c0ffee\" }\n");
    expect_mentions(place.run("run scene.toml").err, {"no pixel has the Cryptomatte object \"#00c0ffee\"", "Suzanne"});
    place.write_scene(tilt + "mask = { object = 3, cryptomatte = \"Suzanne\" }\n");
    EXPECT_EQ(place.run("run scene.toml").err, "");
}

TEST(Commands, RunPassesChannelsThrough) {
    const Workplace place;
    place.write_scene(tilt + "[output]\npassthrough = true\nmarked = true\npng = false\n");
    const Ran ran = place.run("run scene.toml");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(place.files("out"), Names{"normal.exr"});
    const GBufferReader in(data_folder / "gbuffer/small.exr"), out(place / "out/normal.exr");
    EXPECT_EQ(out.roles().channel_of.at("normal.x"), "normal.X") << "the new ones are found when it is read again";
    const std::string depth = "channel:" + in.roles().channel_of.at("depth");
    ASSERT_TRUE(out.has_plane(depth));
    std::vector<float> before(120 * 68), after(120 * 68);
    float *const from[] = {before.data()}, *const to[] = {after.data()};
    in.read_rows(0, 68, std::vector{depth}, from);
    out.read_rows(0, 68, std::vector{depth}, to);
    EXPECT_EQ(before, after);
}

TEST(Commands, FiguresDrawPanelsSideBySide) {
    const Workplace place;
    place.write_scene(tilt + lit + "[[panel]]\ncaption = \"flat\"\nlayers = []\n[[panel]]\ncaption = \"tilted\"\n" +
                      "layers = [\"tilt\"]\n");
    const Ran ran = place.run("figures scene.toml -o drawn");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, "wrote drawn/scene.png\n");
    EXPECT_EQ(place.files("drawn"), Names{"scene.png"});
    expect_failed(place.run("run scene.toml"), {"panel", "wrinkle figures"});
    place.write_scene(tilt);
    expect_failed(place.run("figures scene.toml"), {"[[panel]]", "wrinkle run"});
}

TEST(Commands, RunOverASequence) {
    const Workplace place;
    for (const char* number : {"0003", "0004", "0007"}) {
        fs::copy_file(data_folder / "gbuffer/small.exr", place / fmt::format("shot.{}.exr", number));
        fs::copy_file(data_folder / "gbuffer/small.camera.json", place / fmt::format("cam.{}.json", number));
    }
    place.write_scene(tilt, "shot.####.exr", "file = \"cam.####.json\"");
    const Ran ran = place.run("run scene.toml --frames 3-4,7");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(place.files("out"), (Names{"normal.0003.exr", "normal.0003.png", "normal.0004.exr", "normal.0004.png",
                                         "normal.0007.exr", "normal.0007.png"}));
    EXPECT_EQ(pixels_of(place / "out/normal.0003.png"), pixels_of(place / "out/normal.0007.png"));
    EXPECT_EQ(place.run("explain scene.toml --frame 7 --no-source").code, 0);

    expect_failed(place.run("run scene.toml -o other"), {"shot.####.exr", "--frames"});
    expect_failed(place.run("run scene.toml -o other --frames 5"), {"shot.0005.exr"});
    fs::remove(place / "cam.0004.json");
    expect_failed(place.run("run scene.toml -o other --frames 3-5"),
                  {"cam.0004.json", "shot.0005.exr", "cam.0005.json"});
    expect_failed(place.run("run scene.toml -o other --frames 7-3"), {"7-3"});
    expect_failed(place.run("run scene.toml -o other --frames 3,3"), {"twice"});
    place.write_scene(tilt);
    expect_failed(place.run("run scene.toml -o other --frames 1"), {"--frames", "####"});
    EXPECT_FALSE(fs::exists(place / "other"));
}

TEST(Commands, OneFrameOfASequenceHasToBeNamed) {
    const Workplace place;
    fs::copy_file(data_folder / "gbuffer/small.exr", place / "shot.0007.exr");
    place.write_scene(tilt, "shot.####.exr");
    place.write_scene(tilt, Workplace::data_file("gbuffer/small.exr"),
                      "file = \"" + Workplace::data_file("gbuffer/small.camera.json") + "\"", "still.toml");
    for (const std::string command : {"explain", "info", "scatter -o table.csv --count 3"}) {
        expect_failed(place.run(command + " scene.toml"), {"shot.####.exr", "give --frame"});
        expect_failed(place.run(command + " still.toml --frame 7"), {"small.exr", "--frame needs"});
        const Ran ran = place.run(command + " scene.toml --frame 7");
        EXPECT_EQ(ran.code, 0) << ran.err;
    }
    EXPECT_EQ(place.run("info 'shot.####.exr' --frame 7").code, 0);
}

}  // namespace
}  // namespace wrinkle::test
