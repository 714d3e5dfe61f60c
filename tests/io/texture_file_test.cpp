#include "io/texture_file.h"

#include <cmath>
#include <limits>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

/// The row and column as sixteenths: exact in 8 bits after rounding, different everywhere.
float gradient(int c, int x, int y) { return static_cast<float>(51 * c + 16 * y + x) / 255.0f; }

TEST(TextureFile, IntegersBecomeZeroToOneWithTheBottomRowFirst) {
    TempFolder folder;
    for (const auto& type : {OIIO::TypeUInt8, OIIO::TypeUInt16}) {
        write_exr(folder / "h.png", 5, 7, {"R", "G", "B"}, gradient, type);
        const auto image = load_texture(folder / "h.png", ImageUse::scalar);
        EXPECT_EQ(image.channels, 1);
        EXPECT_EQ(image.width, 5);
        EXPECT_EQ(image.height, 7);
        EXPECT_NEAR(image.at(3, 0, 0), gradient(0, 3, 6), 1e-4);
        EXPECT_NEAR(image.at(3, 6, 0), gradient(0, 3, 0), 1e-4);
        const auto normal = load_texture(folder / "h.png", ImageUse::normal);
        EXPECT_EQ(normal.channels, 3);
        EXPECT_NEAR(normal.at(4, 1, 2), gradient(2, 4, 5), 1e-4);
    }
}

TEST(TextureFile, FloatStaysAsItIs) {
    TempFolder folder;
    write_exr(folder / "h.exr", 6, 4, {"Y"}, [](int, int x, int y) { return static_cast<float>(3 * x - 10 * y); });
    EXPECT_EQ(load_texture(folder / "h.exr", ImageUse::scalar).at(1, 3, 0), 3.0f);
    EXPECT_EQ(load_texture(folder / "h.exr", ImageUse::scalar).at(1, 0, 0), -27.0f);
}

TEST(TextureFile, AlphaDoesNotScaleTheData) {
    TempFolder folder;
    write_exr(
        folder / "a.png", 4, 4, {"R", "G", "B", "A"}, [](int c, int, int) { return c == 3 ? 0.2f : 0.8f; },
        OIIO::TypeUInt8);
    // The file holds associated values divided by alpha; reading must not multiply them again.
    EXPECT_NEAR(load_texture(folder / "a.png", ImageUse::scalar).at(0, 0, 0), 1.0f, 1e-6);
}

TEST(TextureFile, TwoChannelNormalsGetTheirZ) {
    TempFolder folder;
    const float m[2] = {0.6f, -0.3f};
    auto spec = make_spec(3, 3, {"X", "Y"});
    for (const bool is_signed : {false, true}) {
        write_image(folder / "n.exr", {{spec, [&](int c, int, int) { return is_signed ? m[c] : (m[c] + 1) / 2; }}});
        const auto image = load_texture(folder / "n.exr", ImageUse::normal);
        ASSERT_EQ(image.channels, 3);
        EXPECT_NEAR(2 * image.at(1, 1, 0) - 1, m[0], 1e-6);
        EXPECT_NEAR(2 * image.at(1, 1, 1) - 1, m[1], 1e-6);
        EXPECT_NEAR(2 * image.at(1, 1, 2) - 1, std::sqrt(1 - m[0] * m[0] - m[1] * m[1]), 1e-6);
    }
}

TEST(TextureFile, SignedFloatNormalsAreBroughtToZeroToOne) {
    TempFolder folder;
    const float m[3] = {-0.6f, 0, 0.8f};
    write_exr(folder / "n.exr", 2, 2, {"R", "G", "B"}, [&](int c, int, int) { return m[c]; });
    const auto image = load_texture(folder / "n.exr", ImageUse::normal);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(2 * image.at(0, 1, c) - 1, m[c], 1e-6);
}

TEST(TextureFile, ChannelsThatDoNotFit) {
    TempFolder folder;
    write_exr(folder / "grey.png", 2, 2, {"Y"}, gradient, OIIO::TypeUInt8);
    expect_mentions(error_of([&] { load_texture(folder / "grey.png", ImageUse::normal); }),
                    {"grey.png: has 1 channel;", "needs 3", "height_map"});
    write_exr(folder / "xy.exr", 2, 2, {"X", "Y"});
    expect_mentions(error_of([&] { load_texture(folder / "xy.exr", ImageUse::scalar); }), {"has 2 channels"});
    auto grey_alpha = make_spec(2, 2, {"Y", "A"}, OIIO::TypeUInt8);
    grey_alpha.alpha_channel = 1;
    write_image(folder / "ya.png", {{grey_alpha, [](int, int, int) { return 1.0f; }}});
    EXPECT_EQ(load_texture(folder / "ya.png", ImageUse::scalar).at(0, 0, 0), 1.0f);
    expect_mentions(error_of([&] { load_texture(folder / "ya.png", ImageUse::normal); }), {"grey and alpha"});
}

TEST(TextureFile, NanAndInfNameTheirPixel) {
    TempFolder folder;
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        write_exr(folder / "bad.exr", 8, 6, {"Y"}, [&](int, int x, int y) { return x == 5 && y == 2 ? bad : 0.5f; });
        expect_mentions(error_of([&] { load_texture(folder / "bad.exr", ImageUse::scalar); }),
                        {"bad.exr: pixel (5, 2) from the top left is", std::isnan(bad) ? "NaN" : "infinite"});
    }
}

TEST(TextureFile, DamagedFiles) {
    TempFolder folder;
    expect_mentions(error_of([&] { load_texture(folder / "none.png", ImageUse::scalar); }), {"none.png: no such file"});
    write_text(folder / "empty.png", "");
    expect_mentions(error_of([&] { load_texture(folder / "empty.png", ImageUse::scalar); }), {"is empty"});
    write_text(folder / "text.png", "no png");
    expect_mentions(error_of([&] { load_texture(folder / "text.png", ImageUse::scalar); }), {"not an image"});
    write_exr(
        folder / "cut.png", 64, 64, {"Y"},
        [](int, int x, int y) { return static_cast<float>(x * y * 7919 % 251) / 251; }, OIIO::TypeUInt8);
    std::filesystem::resize_file(folder / "cut.png", std::filesystem::file_size(folder / "cut.png") / 2);
    expect_mentions(error_of([&] { load_texture(folder / "cut.png", ImageUse::scalar); }), {"cut.png:", "damaged"});
}

}  // namespace
}  // namespace wrinkle
