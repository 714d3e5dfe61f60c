// A frame with more pixels than its picture: the sizes of the files that it becomes.
#include "io/gbuffer_reader.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

class LargerFrame : public Workplace {
public:
    LargerFrame() {
        const auto data = [](int c, int x, int y) {
            return c == 2 ? 1.0f : c == 3 ? 5.0f : 0.001f * numbered(c, x, y);
        };
        write_exr(*this / "data.exr", 16, 12, {"N.X", "N.Y", "N.Z", "Z"}, data);
        write_exr(*this / "beauty.exr", 8, 6, {"R", "G", "B", "A"},
                  [](int c, int x, int) { return c == 3 ? static_cast<float>(x) / 8 : 0.25f; });
    }
    Ran run_with(const std::string& output) const {
        write_text(*this / "scene.toml",
                   "[gbuffer]\nfile = \"data.exr\"\nbeauty = { file = \"beauty.exr\" }\n"
                   "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov = 10\n"
                   "[[layer]]\nkind = \"constant\"\ngradient = [0.2, 0, 0]\n"
                   "[lighting]\nrelight = \"ratio\"\n[[light]]\nkind = \"sun\"\ndirection = [0.1, 0, -1]\n[output]\n" +
                       output);
        return run("run scene.toml");
    }
    Size size(const std::string& file) const { return GBufferReader(*this / ("out/" + file)).size(); }
};

TEST(BeautySize, PicturesHaveItAndOtherFilesWhereItIsAskedFor) {
    const LargerFrame place;
    constexpr Size data{16, 12}, beauty{8, 6};
    const Ran ran = place.run_with("");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(place.size("normal.exr"), data);
    EXPECT_EQ(place.size("lit.exr"), beauty);
    const auto png = [&](const std::string& name) { return OIIO::ImageInput::open((place / "out" / name).string()); };
    EXPECT_EQ(png("lit.png")->spec().width, 8);
    EXPECT_EQ(png("before.png")->spec().width, 8);
    EXPECT_EQ(png("normal.png")->spec().width, 16);
    const GBufferReader lit(place / "out/lit.exr");
    std::vector<float> alpha(48);
    const std::string plane = "channel:A";
    float* const into = alpha.data();
    lit.read_rows(0, 6, {&plane, 1}, {&into, 1});
    for (std::size_t i = 0; i < alpha.size(); ++i) EXPECT_EQ(alpha[i], static_cast<float>(i % 8) / 8) << i;

    ASSERT_EQ(place.run_with("size = \"beauty\"\nmarked = true").code, 0);
    EXPECT_EQ(place.size("normal.exr"), beauty);
    ASSERT_EQ(place.run_with("size = \"beauty\"\nname = \"all.exr\"").code, 0);
    EXPECT_EQ(place.size("all.exr"), beauty);
}

TEST(BeautySize, FilesOfTwoSizesAreRefused) {
    const LargerFrame place;
    expect_failed(place.run_with("name = \"all.exr\""), {"data.exr", "2 x 2", "size = \"beauty\""});
    expect_failed(place.run_with("size = \"beauty\"\npassthrough = true"), {"data.exr", "passthrough"});
    expect_failed(place.run_with("size = \"half\""), {"scene.toml:", "size", "data", "beauty"});
}

}  // namespace
}  // namespace wrinkle::test
