#include <nlohmann/json.hpp>

#include "io/gbuffer_reader.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

/// A wall of 8 x 6 pixels as frame.0001.exr and so on.
class Sequence : public testing::Test {
protected:
    explicit Sequence(int frames = 3) {
        for (int frame = 1; frame <= frames; ++frame) write_frame(frame);
    }
    void write_frame(int frame) const {
        write_exr(place_ / fmt::format("frame.{:04}.exr", frame), 8, 6,
                  {"N.X", "N.Y", "N.Z", "Z", "uv.u", "uv.v", "R", "G", "B"}, [](int c, int x, int y) {
                      return c == 2 ? 1.0f : c == 3 ? 5.0f : c == 4 ? x / 8.0f : c == 5 ? y / 8.0f : 0.25f;
                  });
    }
    void write_scene(const std::string& text) const {
        write_text(place_ / "scene.toml",
                   "[gbuffer]\nfile = \"frame.####.exr\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n"
                   "up = [0, 1, 0]\nfov = 10\n" +
                       text);
    }
    std::vector<std::string> channels(const std::string& file) const { return GBufferReader(place_ / file).channels(); }

    const Workplace place_;
};

const std::string relit = "[lighting]\nrelight = \"ratio\"\n[[light]]\nkind = \"sun\"\ndirection = [0.1, 0, -1]\n";

TEST_F(Sequence, FilesAreNamedAsTheSceneSays) {
    write_scene(tilt + relit +
                "[output]\nname = \"bump.$F3.exr\"\npictures = [\"lit\"]\npng = 16\nchannel_names = \"N.x\"\n"
                "compression = \"none\"\n");
    const Ran ran = place_.run("run scene.toml --frames 1-3x2");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(place_.files("out"),
              (std::vector<std::string>{"bump.001.exr", "bump.003.exr", "lit.0001.png", "lit.0003.png"}));
    const auto names = channels("out/bump.003.exr");
    for (const char* name : {"N.x", "R", "B"}) EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
    const auto png = OIIO::ImageInput::open((place_ / "out/lit.0001.png").string());
    ASSERT_TRUE(png);
    EXPECT_EQ(png->spec().format, OIIO::TypeUInt16);
}

TEST_F(Sequence, NamesThatDoNotFitTheFramesAreRefused) {
    write_scene(tilt + "[output]\nname = \"bump.exr\"\n");
    expect_failed(place_.run("run scene.toml --frames 1-3"), {"\"bump.exr\"", "3 frames would replace each other"});
    EXPECT_EQ(place_.run("run scene.toml --frames 2 --quiet").code, 0);
    place_.write_scene(tilt + "[output]\nname = \"bump.####.exr\"\n");
    expect_failed(place_.run("run scene.toml"), {"holds a place for a frame number: give --frames"});
}

TEST_F(Sequence, TexturesMayDifferFromFrameToFrame) {
    for (const int frame : {1, 2})
        write_exr(place_ / fmt::format("h.{}.exr", frame), 8, 8, {"Y"},
                  [&](int, int x, int) { return frame == 1 ? 0.0f : 0.1f * static_cast<float>(x % 4); });
    write_scene("[[layer]]\nkind = \"height_map\"\ntexture = \"h.#.exr\"\n[output]\npng = false\n");
    expect_failed(place_.run("run scene.toml"), {"h.#.exr", "holds a place for a frame number"});
    expect_failed(place_.run("run scene.toml --frames 1-3"), {"no such file", "h.3.exr"});
    const Ran ran = place_.run("run scene.toml --frames 1-2");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(read_text(place_ / "out/normal.0001.exr"), read_text(place_ / "out/normal.0002.exr"));
    EXPECT_EQ(place_.run("info scene.toml --frame 2").code, 0);
    const Ran single = place_.run("run scene.toml --frames 2 -o alone --quiet");
    EXPECT_EQ(single.code, 0) << single.err;
    EXPECT_EQ(read_text(place_ / "out/normal.0002.exr"), read_text(place_ / "alone/normal.0002.exr"));
}

TEST_F(Sequence, ValuesAreSetOnTheCommandLine) {
    write_scene(tilt + "[output]\npng = false\n");
    EXPECT_EQ(place_.run("run scene.toml --frames 1 --quiet -o a").code, 0);
    EXPECT_EQ(
        place_.run("run --set layer.tilt.scale=0.5 scene.toml --set output.half=false --frames 1 --quiet -o b").code,
        0);
    EXPECT_NE(read_text(place_ / "a/normal.0001.exr"), read_text(place_ / "b/normal.0001.exr"));
    expect_failed(place_.run("run scene.toml --set layer.tlt.scale=1 --frames 1"), {"there is no layer \"tlt\""});
    expect_mentions(place_.run("explain scene.toml --frame 1 --no-source --set layer.tilt.scale=0.5").out,
                    {"constant"});
}

/// How many frames a run says that it evaluated, skipped and did not bring off.
struct Counts {
    int frames = 0, skipped = 0;
    std::size_t failed = 0;
    bool operator==(const Counts&) const = default;
};
Counts counts_of(const Ran& ran) {
    const auto last = ran.out.rfind("\n", ran.out.size() - 2);
    const auto report = nlohmann::json::parse(ran.out.substr(last == std::string::npos ? 0 : last + 1));
    return {report.at("frames"), report.at("skipped"), report.at("failed").size()};
}

TEST_F(Sequence, WhatIsDoneIsSkippedUntilSomethingChanges) {
    write_scene(tilt + relit);
    const auto counts = [&](const std::string& more) {
        const Ran ran = place_.run("run scene.toml --frames 1-3 --resume --json " + more);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return counts_of(ran);
    };
    EXPECT_EQ(counts(""), (Counts{3, 0, 0}));
    const std::string first = read_text(place_ / "out/normal.0002.exr");
    EXPECT_EQ(counts(""), (Counts{0, 3, 0}));
    EXPECT_EQ(counts("--force"), (Counts{3, 0, 0}));
    EXPECT_EQ(read_text(place_ / "out/normal.0002.exr"), first);
    fs::resize_file(place_ / "out/lit.0002.png", fs::file_size(place_ / "out/lit.0002.png") - 1);
    fs::resize_file(place_ / "out/normal.0003.exr", fs::file_size(place_ / "out/normal.0003.exr") - 1);
    EXPECT_EQ(counts(""), (Counts{2, 1, 0}));
    fs::remove(place_ / "out/before.0001.png");
    EXPECT_EQ(counts(""), (Counts{1, 2, 0}));
    fs::last_write_time(place_ / "frame.0003.exr", fs::file_time_type::clock::now() + std::chrono::seconds(5));
    EXPECT_EQ(counts(""), (Counts{1, 2, 0}));
    EXPECT_EQ(counts("--set layer.tilt.scale=2"), (Counts{3, 0, 0}));
    write_scene("# a remark\n" + tilt + relit);
    EXPECT_EQ(counts("--set layer.tilt.scale=2"), (Counts{0, 3, 0}));
    EXPECT_EQ(counts("--set layer.tilt.scale=2 --precision exact"), (Counts{3, 0, 0}));
}

TEST_F(Sequence, AKilledRunGoesOnWhereItWas) {
    constexpr int frames = 24;
    for (int frame = 4; frame <= frames; ++frame) write_frame(frame);
    write_scene(tilt + relit);
    const std::string run = fmt::format("run scene.toml --frames 1-{} --quiet", frames);
    ASSERT_EQ(place_.run(run + " -o whole").code, 0);
    const std::string killed = fmt::format(
        "cd '{}' && {{ '{}' {} --resume -o out & }} ; pid=$!; while [ ! -e out/before.0003.png ] && kill -0 $pid; do "
        "sleep 0.002; done; kill -9 $pid; wait $pid 2> /dev/null",
        (place_ / "").string(), WRINKLE_CLI, run);
    ASSERT_NE(std::system(killed.c_str()), -1);
    const auto done = place_.files("out").size();
    EXPECT_GE(done, 15u);
    EXPECT_LT(done, std::size_t{5} * frames) << "it was done before it was killed";
    const Ran resumed = place_.run(fmt::format("run scene.toml --frames 1-{} --resume --json", frames));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_GE(counts_of(resumed).skipped, 3);
    ASSERT_EQ(place_.files("out"), place_.files("whole"));
    for (const std::string& name : place_.files("whole"))
        EXPECT_EQ(read_text(place_ / ("out/" + name)), read_text(place_ / ("whole/" + name))) << name;
}

TEST_F(Sequence, OneBadFrameDoesNotStopTheOthers) {
    write_scene(tilt);
    fs::remove(place_ / "frame.0001.exr");
    fs::resize_file(place_ / "frame.0003.exr", fs::file_size(place_ / "frame.0003.exr") / 2);
    write_frame(4);
    expect_failed(place_.run("run scene.toml --frames 1-4 --quiet"), {"no such file", "frame.0001.exr"});
    EXPECT_EQ(place_.files("out"), std::vector<std::string>{});
    const Ran ran = place_.run("run scene.toml --frames 1-4 --keep-going --json");
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(counts_of(ran), (Counts{2, 0, 2}));
    expect_mentions(ran.err, {"2 of 4 frames failed", "frame 1: ", "frame.0001.exr", "frame 3: ", "frame.0003.exr"});
    EXPECT_EQ(place_.files("out"),
              (std::vector<std::string>{"normal.0002.exr", "normal.0002.png", "normal.0004.exr", "normal.0004.png"}));
}

TEST_F(Sequence, WarningsFailWhereTheyAreNotWanted) {
    write_scene(tilt + "mask = { object = 99 }\n");
    write_exr(place_ / "frame.0001.exr", 8, 6, {"N.X", "N.Y", "N.Z", "Z", "id"}, [](int c, int, int) {
        return c == 2 ? 1.0f : c == 3 ? 5.0f : 0.0f;
    });
    const Ran warned = place_.run("run scene.toml --frames 1");
    EXPECT_EQ(warned.code, 0) << warned.err;
    expect_mentions(warned.err, {"warning: ", "99"});
    const Ran refused = place_.run("run scene.toml --frames 1 --strict");
    EXPECT_EQ(refused.code, 1);
    expect_mentions(refused.err, {"99", "--strict"});
    write_exr(
        place_ / "t.png", 8, 8, {"R", "G", "B"}, [](int c, int, int) { return c == 2 ? 1.0f : 0.737f; },
        OIIO::TypeUInt8);
    write_scene("[[layer]]\nkind = \"normal_map\"\ntexture = \"t.png\"\n");
    expect_failed(place_.run("run scene.toml --frames 2-3 --strict -o strict"), {"sRGB's curve", "--strict"});
    EXPECT_EQ(place_.files("strict"), std::vector<std::string>{});
}

TEST_F(Sequence, EachFrameHasALine) {
    write_scene(tilt);
    const Ran text = place_.run("run scene.toml --frames 1-3");
    expect_mentions(text.err, {"frame 1 written (1 of 3): ", " s, 0:00 left\n", "frame 3 written (3 of 3): "});
    expect_mentions(place_.run("run scene.toml --frames 1-3 --resume").err, {"frame 2 skipped (2 of 3)"});
    const Ran json = place_.run("run scene.toml --frames 1-3 --json");
    std::istringstream lines(json.out);
    std::vector<nlohmann::json> parsed;
    for (std::string line; std::getline(lines, line);) parsed.push_back(nlohmann::json::parse(line));
    ASSERT_EQ(parsed.size(), 4u);
    EXPECT_EQ(parsed[1].at("frame"), 2);
    EXPECT_EQ(parsed[1].at("files").size(), 2u);
    EXPECT_GT(parsed[1].at("seconds_left"), 0);
    EXPECT_EQ(parsed[3].at("files").size(), 6u);
}

}  // namespace
}  // namespace wrinkle::test
