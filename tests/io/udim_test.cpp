#include "io/texture_file.h"

#include "io/texture_doubts.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

TEST(Udim, TilesBecomeOneImage) {
    TempFolder folder;
    const auto tile = [&](int number, float value) {
        write_exr(folder / ("t." + std::to_string(number) + ".exr"), 2, 2, {"R", "G"},
                  [=](int, int, int) { return value; });
    };
    tile(1001, 0.25f), tile(1003, 0.5f), tile(1011, 0.75f);
    TextureUse use{.file = folder / "t.<UDIM>.exr",
                   .content = Content::slope,
                   .encoding = Encoding::sign,
                   .unit = SlopeUnit::texture};
    const Image slopes = load_bump(use);
    ASSERT_EQ(slopes.width, 6);
    ASSERT_EQ(slopes.height, 4);
    EXPECT_FLOAT_EQ(slopes.at(0, 0, 0), 3 * 0.25f);  // the image spans three textures
    EXPECT_FLOAT_EQ(slopes.at(0, 0, 1), 2 * 0.25f);
    EXPECT_FLOAT_EQ(slopes.at(5, 1, 0), 3 * 0.5f);
    EXPECT_FLOAT_EQ(slopes.at(1, 3, 1), 2 * 0.75f);
    EXPECT_EQ(slopes.at(3, 0, 0), 0) << "no tile: flat";
    expect_mentions(io::texture_doubt(use, slopes), {"t.<UDIM>.exr", "no tile 1002 among its 3"});
    write_exr(folder / "t.1002.exr", 4, 4, {"R", "G"});
    expect_mentions(error_of([&] { load_bump(use); }), {"t.1002.exr: 4 x 4 texels", "have 2 x 2"});
    use.file = folder / "u.<UDIM>.exr";
    expect_mentions(error_of([&] { load_bump(use); }), {"there is no tile"});
}

TEST(Udim, TilesOfBumpslopesBringTheirProductsAllOrNone) {
    TempFolder folder;
    const std::vector<std::string> six{"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"};
    const auto texel = [](int c, int, int) { return c < 3 ? 0.5f : c == 5 ? -0.25f : 1.0f; };
    write_exr(folder / "t.1001.exr", 2, 2, six, texel);
    write_exr(folder / "t.1002.exr", 2, 2, six, texel);
    const TextureUse use{.file = folder / "t.<UDIM>.exr", .content = Content::slope};
    const Image slopes = load_bump(use);
    ASSERT_EQ(slopes.channels, 5);
    EXPECT_FLOAT_EQ(slopes.at(3, 0, 0), 2 * 2 * 0.5f);  // per texel, of two, and the image spans two textures
    EXPECT_FLOAT_EQ(slopes.at(3, 0, 2), 4 * 4 * 1.0f);
    EXPECT_FLOAT_EQ(slopes.at(3, 0, 3), 4 * 2 * 0.25f);
    EXPECT_FLOAT_EQ(slopes.at(3, 0, 4), 2 * 2 * 1.0f);
    write_exr(folder / "t.1003.exr", 2, 2, {six.begin(), six.begin() + 3}, texel);
    expect_mentions(error_of([&] { load_bump(use); }), {"t.1003.exr: lacks means", "maketx --bumpslopes"});
}

}  // namespace
}  // namespace wrinkle
