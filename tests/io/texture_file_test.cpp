#include "io/texture_file.h"

#include <cmath>
#include <limits>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

/// A number that differs in every channel and pixel, and is exact when it is stored in 8 bits.
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

TEST(TextureFile, SlopesArePerUnitOfTextureWithTUp) {
    TempFolder folder;
    const auto slope = [](int c, int, int y) {
        return c == 0 ? 0.25f : c == 1 ? -0.5f + 0.1f * static_cast<float>(y) : 9.0f;
    };
    write_exr(folder / "d.exr", 8, 4, {"R", "G", "B"}, slope);
    const Image per_texel = load_slopes(folder / "d.exr", Encoding::automatic, SlopeUnit::texel);
    EXPECT_EQ(per_texel.channels, 2);
    EXPECT_FLOAT_EQ(per_texel.at(0, 3, 0), 0.25f * 8);
    EXPECT_FLOAT_EQ(per_texel.at(0, 3, 1), -0.5f * 4);  // the top row
    EXPECT_FLOAT_EQ(load_slopes(folder / "d.exr", Encoding::sign, SlopeUnit::texture).at(5, 3, 1), -0.5f);
    EXPECT_FLOAT_EQ(load_slopes(folder / "d.exr", Encoding::unit, SlopeUnit::texture).at(5, 3, 0), -0.5f);
    const auto ends = [](int c, int, int) { return c == 0 ? 1.0f : 0.0f; };
    write_exr(folder / "d.png", 8, 4, {"R", "G", "B"}, ends, OIIO::TypeUInt8);
    const Image packed = load_slopes(folder / "d.png", Encoding::automatic, SlopeUnit::texture);
    EXPECT_FLOAT_EQ(packed.at(2, 2, 0), 1);
    EXPECT_FLOAT_EQ(packed.at(2, 2, 1), -1);
}

TEST(TextureFile, BumpslopesAreKnownByTheirChannels) {
    TempFolder folder;
    // Slopes along a t that points down.
    const auto ramp = [](int c, int, int) { return c == 1 ? 0.25f : c == 2 ? 0.5f : 7.0f; };
    auto spec = make_spec(8, 4, {"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"});
    write_image(folder / "b.exr", {{spec, ramp}});
    const Image texels = load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texture);
    EXPECT_FLOAT_EQ(texels.at(3, 1, 0), 0.25f * 8);
    EXPECT_FLOAT_EQ(texels.at(3, 1, 1), -0.5f * 4);
    spec.attribute("uvslopes_scale", 16.0f);
    write_image(folder / "b.exr", {{spec, ramp}});
    EXPECT_FLOAT_EQ(load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texel).at(3, 1, 1), -0.5f * 16);
    // Made from normals: heights of -1, and t points up.
    const auto of_normals = [&](int c, int x, int y) { return c == 0 ? -1.0f : ramp(c, x, y); };
    write_image(folder / "b.exr", {{spec, of_normals}});
    EXPECT_FLOAT_EQ(load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texel).at(3, 1, 1), 0.5f * 16);
    // A file that maketx itself wrote: its slopes must be those of its heights.
    const auto file = std::filesystem::path(WRINKLE_SOURCE_DIR) / "data/textures/ripples_bumpslopes.exr";
    const Image height = load_texture(file, ImageUse::scalar);
    const Image slopes = load_slopes(file, Encoding::automatic, SlopeUnit::texel);
    for (int y = 1; y < 63; y += 7)
        for (int x = 1; x < 63; x += 5) {
            EXPECT_NEAR(slopes.at(x, y, 0), 32 * (height.at(x + 1, y, 0) - height.at(x - 1, y, 0)), 4) << x << " " << y;
            EXPECT_NEAR(slopes.at(x, y, 1), 32 * (height.at(x, y + 1, 0) - height.at(x, y - 1, 0)), 4) << x << " " << y;
        }
}

TEST(TextureFile, BumpslopesBringTheirMeansOfProducts) {
    TempFolder folder;
    // Means: dh/ds .25, dh/dt -.5 with t down; squares .5 and .75, product -.25.
    const float means[] = {3, 0.25f, -0.5f, 0.5f, 0.75f, -0.25f};
    float square = means[3];
    const auto texel = [&](int c, int, int) { return c == 3 ? square : means[c]; };
    const auto spec = make_spec(8, 4, {"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"});
    write_image(folder / "b.exr", {{spec, texel}});
    const Image slopes = load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texture);
    ASSERT_EQ(slopes.channels, 5);
    const float wanted[] = {0.25f * 8, 0.5f * 4, 0.5f * 8 * 8, 0.25f * 8 * 4, 0.75f * 4 * 4};
    for (int c = 0; c < 5; ++c) EXPECT_FLOAT_EQ(slopes.at(3, 1, c), wanted[c]) << c;
    square = 0.05f;
    write_image(folder / "b.exr", {{spec, texel}});
    expect_mentions(error_of([&] { load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texture); }),
                    {"b.exr: pixel (0, 3) from the top left has 0.05 in b3_dhds2", "at least 0.0625", "maketx"});
    // A file without them has its slopes alone.
    write_image(folder / "b.exr", {{make_spec(8, 4, {"b0_h", "b1_dhds", "b2_dhdt"}), texel}});
    EXPECT_EQ(load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texture).channels, 2);
    // A texel or so may be what lossy compression made of it.
    const auto once = [&](int c, int x, int y) { return c == 3 && (x != 5 || y != 2) ? means[3] : texel(c, x, y); };
    write_image(folder / "b.exr", {{make_spec(16, 8, spec.channelnames), once}});
    EXPECT_EQ(load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texture).channels, 5);
}

TEST(TextureFile, SlopesOfTheWrongChannels) {
    TempFolder folder;
    write_exr(folder / "h.exr", 4, 4, {"Y"});
    expect_mentions(error_of([&] { load_slopes(folder / "h.exr", Encoding::automatic, SlopeUnit::texel); }),
                    {"h.exr: has 1 channel; a derivative map needs 2"});
    write_exr(folder / "b.exr", 4, 4, {"a", "b", "c", "d", "e", "f"});
    expect_mentions(error_of([&] { load_slopes(folder / "b.exr", Encoding::automatic, SlopeUnit::texel); }),
                    {"has 6 channels", "maketx --bumpslopes", "b1_dhds"});
    const auto bumpslopes = std::filesystem::path(WRINKLE_SOURCE_DIR) / "data/textures/ripples_bumpslopes.exr";
    expect_mentions(error_of([&] { load_slopes(bumpslopes, Encoding::automatic, SlopeUnit::metre); }),
                    {"ripples_bumpslopes.exr", "per texture", "metres over metres", "content = \"height\""});
}

TEST(TextureFile, ObjectNormalsBecomeVectors) {
    TempFolder folder;
    const auto packed = [](int c, int x, int) { return x == 0 ? 128.0f / 255 : c == 2 ? 0.0f : 0.5f; };
    write_exr(folder / "n.png", 4, 3, {"R", "G", "B"}, packed, OIIO::TypeUInt8);
    const Image image = load_texture(folder / "n.png", ImageUse::object_normal);
    ASSERT_EQ(image.channels, 3);
    EXPECT_NEAR(image.at(1, 1, 2), -1, 1e-6);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(0, 1, c), 0) << "grey is no normal";
    // Floats are vectors as they are, even when no component is negative, unless they have unit length only once they
    // are unpacked.
    write_exr(folder / "v.exr", 4, 3, {"R", "G", "B"}, [](int c, int, int) { return c == 2 ? 1.0f : 0.0f; });
    EXPECT_EQ(load_texture(folder / "v.exr", ImageUse::object_normal).at(1, 1, 2), 1);
    write_exr(folder / "p.exr", 4, 3, {"R", "G", "B"}, [](int c, int, int) { return c == 2 ? 1.0f : 0.5f; });
    EXPECT_EQ(load_texture(folder / "p.exr", ImageUse::object_normal).at(1, 1, 0), 0);
    write_exr(folder / "two.exr", 4, 3, {"X", "Y"});
    expect_mentions(error_of([&] { load_texture(folder / "two.exr", ImageUse::object_normal); }),
                    {"has 2 channels", "object-space normal map needs 3"});
}

TEST(TextureFile, AlphaDoesNotScaleTheData) {
    TempFolder folder;
    write_exr(
        folder / "a.png", 4, 4, {"R", "G", "B", "A"}, [](int c, int, int) { return c == 3 ? 0.2f : 0.8f; },
        OIIO::TypeUInt8);
    // PNG stores colours that are not multiplied by alpha; reading must not multiply them.
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

TEST(TextureFile, FloatNormalsAreWhatMostOfThemLookLike) {
    TempFolder folder;
    const auto flat = make_spec(4, 4, {"R", "G", "B"});
    const auto z_of = [&](auto texel) {
        write_image(folder / "n.exr", {{flat, texel}});
        return 2 * load_texture(folder / "n.exr", ImageUse::normal).at(2, 2, 2) - 1;
    };
    EXPECT_NEAR(z_of([](int c, int, int) { return c == 2 ? 1.0f : 0.0f; }), 1, 1e-6) << "flat, signed";
    const auto ringing = [](int c, int x, int y) { return c == 2 ? 1.0f : x + y == 0 ? -0.001f : 0.5f; };
    EXPECT_NEAR(z_of(ringing), 1, 1e-6) << "flat, in [0,1], but for what a resize left in a corner";
}

TEST(TextureFile, ChannelsThatDoNotFit) {
    TempFolder folder;
    write_exr(folder / "grey.png", 2, 2, {"Y"}, gradient, OIIO::TypeUInt8);
    expect_mentions(error_of([&] { load_texture(folder / "grey.png", ImageUse::normal); }),
                    {"grey.png: has 1 channel;", "needs 3", "height_map"});
    write_exr(folder / "xy.exr", 2, 2, {"X", "Y"});
    expect_mentions(error_of([&] { load_texture(folder / "xy.exr", ImageUse::scalar); }),
                    {"\"X\", \"Y\" could be the heights", "say which"});
    auto grey_alpha = make_spec(2, 2, {"Y", "A"}, OIIO::TypeUInt8);
    grey_alpha.alpha_channel = 1;
    write_image(folder / "ya.png", {{grey_alpha, [](int, int, int) { return 1.0f; }}});
    EXPECT_EQ(load_texture(folder / "ya.png", ImageUse::scalar).at(0, 0, 0), 1.0f);
    expect_mentions(error_of([&] { load_texture(folder / "ya.png", ImageUse::normal); }), {"grey and alpha"});
}

TEST(TextureFile, ZeroToOneIsTheDisplayWindow) {
    TempFolder folder;
    auto crop = make_spec(4, 4, {"Y"}), overscan = make_spec(12, 12, {"Y"});
    crop.x = crop.y = 2, overscan.x = overscan.y = -2;
    for (auto* spec : {&crop, &overscan}) spec->full_width = spec->full_height = 8;
    const auto value = [](int x, int y) { return static_cast<float>(10 * y + x); };
    write_image(folder / "crop.exr", {{crop, [&](int, int x, int y) { return value(x + 2, y + 2); }}});
    write_image(folder / "over.exr", {{overscan, [&](int, int x, int y) { return value(x - 2, y - 2); }}});
    const Image inner = load_texture(folder / "crop.exr", ImageUse::scalar);
    const Image outer = load_texture(folder / "over.exr", ImageUse::scalar);
    ASSERT_EQ(inner.width, 8);
    ASSERT_EQ(outer.height, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
            EXPECT_EQ(inner.at(x, 7 - y, 0), inside ? value(x, y) : 0);
            EXPECT_EQ(outer.at(x, 7 - y, 0), value(x, y));
        }
}

TEST(TextureFile, OfSeveralLayersTheOneThatFits) {
    TempFolder folder;
    const auto number = [](int c, int, int) { return static_cast<float>(c) / 8; };
    write_exr(folder / "n.exr", 2, 2, {"Depth.Z", "Normal.X", "Normal.Y", "Normal.Z"}, number);
    EXPECT_FLOAT_EQ(load_texture(folder / "n.exr", ImageUse::object_normal).at(0, 0, 0), 1.0f / 8);
    write_exr(folder / "h.exr", 2, 2, {"A", "coverage", "displacement"}, number);
    EXPECT_FLOAT_EQ(load_texture(folder / "h.exr", ImageUse::scalar).at(0, 0, 0), 2.0f / 8);
    write_exr(folder / "a.exr", 2, 2, {"A"}, number);
    expect_mentions(error_of([&] { load_texture(folder / "a.exr", ImageUse::scalar); }), {"nothing but alpha"});
    write_exr(folder / "two.exr", 2, 2, {"a.X", "a.Y", "a.Z", "b.X", "b.Y", "b.Z"}, number);
    expect_mentions(error_of([&] { load_texture(folder / "two.exr", ImageUse::normal); }),
                    {"two.exr: \"a\", \"b\" could be the normals", "layer = "});
    TextureUse use{.file = folder / "two.exr", .content = Content::object_normal};
    use.layer = "b";
    EXPECT_FLOAT_EQ(load_bump(use).at(0, 0, 1), 4.0f / 8);
    use.layer = "c";
    expect_mentions(error_of([&] { load_bump(use); }), {"there is no layer \"c\"", "a.XYZ, b.XYZ"});
    use.layer.clear();
    use.channels = {"b.Z", "b.X", "a.Y"};
    EXPECT_FLOAT_EQ(load_bump(use).at(0, 0, 0), 5.0f / 8);
    EXPECT_FLOAT_EQ(load_bump(use).at(0, 0, 2), 1.0f / 8);
    use.channels = {"b.Q"};
    expect_mentions(error_of([&] { load_bump(use); }), {"no channel \"b.Q\"", "did you mean \"b."});
}

TEST(TextureFile, TheZeroOfPackedIntegersMayBe128) {
    TempFolder folder;
    const auto stored = [](int c, int, int) { return (c == 0 ? 128.0f : c == 1 ? 1.0f : 255.0f) / 255; };
    write_exr(folder / "n.png", 2, 2, {"R", "G", "B"}, stored, OIIO::TypeUInt8);
    TextureUse use{.file = folder / "n.png", .content = Content::normal};
    use.zero = 128;
    const auto normal = [&](int c) { return 2 * load_bump(use).at(0, 0, c) - 1; };
    EXPECT_NEAR(normal(0), 0, 1e-6);
    EXPECT_NEAR(normal(1), -1, 1e-6);
    EXPECT_NEAR(normal(2), 1, 1e-6);
    write_exr(folder / "n.exr", 2, 2, {"R", "G", "B"}, stored);
    use.file = folder / "n.exr";
    expect_mentions(error_of([&] { load_bump(use); }), {"zero = 128 is for integers"});
    write_exr(folder / "n.png", 2, 2, {"R", "G", "B"}, stored, OIIO::TypeUInt16);
    use.file = folder / "n.png";
    expect_mentions(error_of([&] { load_bump(use); }), {"zero = 128", "32768 for 16 bits"});
}

TEST(TextureFile, IntegersOf32BitsAreNoHeights) {
    TempFolder folder;
    write_exr(
        folder / "h.exr", 2, 2, {"Y"}, [](int, int x, int) { return static_cast<float>(x); }, OIIO::TypeUInt32);
    expect_mentions(error_of([&] { load_texture(folder / "h.exr", ImageUse::scalar); }), {"\"Y\"", "32-bit integers"});
}

}  // namespace
}  // namespace wrinkle
