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
    std::vector<std::string> channels(const std::string& file) const {
        return GBufferReader(place_ / file).channels();
    }

    const Workplace place_;
};

const std::string relit =
    "[lighting]\nrelight = \"ratio\"\n[[light]]\nkind = \"sun\"\ndirection = [0.1, 0, -1]\n";

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
    EXPECT_EQ(place_.run("run --set layer.tilt.scale=0.5 scene.toml --set output.half=false --frames 1 --quiet -o b").code,
              0);
    EXPECT_NE(read_text(place_ / "a/normal.0001.exr"), read_text(place_ / "b/normal.0001.exr"));
    expect_failed(place_.run("run scene.toml --set layer.tlt.scale=1 --frames 1"), {"there is no layer \"tlt\""});
    expect_mentions(place_.run("explain scene.toml --frame 1 --no-source --set layer.tilt.scale=0.5").out, {"constant"});
}

}  // namespace
}  // namespace wrinkle::test
