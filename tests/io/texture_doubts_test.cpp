#include "io/texture_doubts.h"

#include <cmath>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

float by_srgb(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

/// Normals of waves, as (n + 1) / 2.
float waves(int c, int x, int y) {
    const float a = 0.4f * std::sin(0.4f * static_cast<float>(x)), b = 0.3f * std::cos(0.5f * static_cast<float>(y));
    const float length = std::sqrt(a * a + b * b + 1);
    return ((c == 0 ? a : c == 1 ? b : 1) / length + 1) / 2;
}

std::string doubt_of(Content content, const Pixel& pixel, const char* file = "a.png",
                     OIIO::TypeDesc type = OIIO::TypeUInt8) {
    const TempFolder folder;
    write_exr(folder / file, 32, 32, {"R", "G", "B"}, pixel, type);
    const TextureUse use{.file = folder / file, .content = content};
    return io::texture_doubt(use, load_bump(use));
}

TEST(TextureDoubts, AreNoneOfSoundMaps) {
    EXPECT_EQ(doubt_of(Content::normal, waves), "");
    EXPECT_EQ(doubt_of(Content::normal, [](int c, int, int) { return c == 2 ? 1.0f : 128.0f / 255; }), "") << "flat";
    const auto sphere = [](int c, int x, int y) {
        const float a = 0.2f * static_cast<float>(x), b = 0.1f * static_cast<float>(y);
        return ((c == 0 ? std::cos(a) * std::sin(b) : c == 1 ? std::sin(a) * std::sin(b) : std::cos(b)) + 1) / 2;
    };
    EXPECT_EQ(doubt_of(Content::object_normal, sphere), "");
    EXPECT_EQ(doubt_of(Content::object_normal, [](int, int, int) { return 0.5f; }), "") << "nothing to judge by";
    EXPECT_EQ(doubt_of(Content::height, [](int, int x, int) { return static_cast<float>(x) / 64; }), "") << "grey";
    EXPECT_EQ(doubt_of(Content::height, waves, "a.exr", OIIO::TypeFloat), "") << "layers are told by their names";
    expect_mentions(doubt_of(Content::normal, sphere),
                    {"a.png", "% of its normals point into the surface", "kind = \"object_normal\""});
}

TEST(TextureDoubts, AreToldOfSrgbNoNormalsAndColours) {
    const auto encoded = [](int c, int x, int y) { return by_srgb(waves(c, x, y)); };
    for (const Content content : {Content::normal, Content::object_normal})
        expect_mentions(doubt_of(content, encoded), {"a.png", "sRGB's curve", "188 of 255", "non-colour"});
    expect_mentions(doubt_of(Content::normal, [](int, int x, int) { return 0.6f + static_cast<float>(x % 2) / 5; }),
                    {"a.png", "unit length", "is it a normal map?"});
    expect_mentions(doubt_of(Content::height, waves), {"a.png", "in colour", "is it a height map?"});
}

/// Without z in the file, lengths tell nothing.
TEST(TextureDoubts, AreToldOfSrgbInTwoChannels) {
    const TempFolder folder;
    write_exr(folder / "a.exr", 32, 32, {"R", "G"}, [](int c, int x, int y) { return by_srgb(waves(c, x, y)); });
    const TextureUse use{.file = folder / "a.exr", .content = Content::normal};
    expect_mentions(io::texture_doubt(use, load_bump(use)), {"a.exr", "sRGB's curve"});
}

}  // namespace
}  // namespace wrinkle
