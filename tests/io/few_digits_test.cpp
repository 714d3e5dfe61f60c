// Files that hold fewer digits than their channels have room for, or than their header says there are bytes of.
#include <half.h>

#include <cmath>

#include "io/gbuffer_reader.h"
#include "io/texture_file.h"
#include "io/uv_digits.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

float uv_of(int channel, int x, int y) {
    return channel == 0 ? (static_cast<float>(x) + 0.31f) / 97 : (static_cast<float>(y) + 0.77f) / 61;
}

io::UvDigits digits_of(const std::function<float(float)>& round) {
    const TempFolder folder;
    write_exr(folder / "a.exr", 64, 32, {"uv.U", "uv.V"}, [&](int c, int x, int y) { return round(uv_of(c, x, y)); });
    return io::uv_digits(GBufferReader(folder / "a.exr"));
}

TEST(FewDigits, OfUvAreSeenInWideChannels) {
    EXPECT_EQ(digits_of([](float v) { return v; }), io::UvDigits::enough);
    EXPECT_EQ(digits_of([](float v) { return static_cast<float>(Imath::half(v)); }), io::UvDigits::half);
    EXPECT_EQ(digits_of([](float v) { return std::round(255 * v) / 255; }), io::UvDigits::byte);
    EXPECT_EQ(digits_of([](float v) { return std::ldexp(std::round(std::ldexp(v, 7)), -7); }), io::UvDigits::enough)
        << "a ramp over 64 pixels";
    EXPECT_EQ(digits_of([](float) { return 0.0f; }), io::UvDigits::enough) << "nothing to judge by";
}

TEST(FewDigits, LeaveNoCryptomatte) {
    const TempFolder folder;
    const std::vector<std::string> channels{"CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b",
                                            "CryptoObject00.a"};
    const std::vector<std::string> plane{"crypto.id0"};
    for (const char* compression : {"pxr24", "dwaa", "dwab"}) {
        auto spec = make_spec(32, 32, channels);
        spec.attribute("compression", compression);
        write_image(folder / "a.exr", {{spec, numbered}});
        const GBufferReader reader(folder / "a.exr");
        expect_mentions(error_of([&] { reader.require(plane); }),
                        {"CryptoObject00.r", std::string(compression).substr(0, 4), "its ids are lost", "ZIP"});
    }
    write_exr(folder / "a.exr", 32, 32, channels);
    GBufferReader(folder / "a.exr").require(plane);
}

TEST(FewDigits, SignedIntegersHoldSignedNormalsAndSlopes) {
    const TempFolder folder;
    const auto texel = [](int c, int x, int) { return c == 2 ? 0.8f : c == 0 ? (x % 2 ? 0.6f : -0.6f) : 0.0f; };
    for (const auto& type : {OIIO::TypeDesc(OIIO::TypeDesc::INT16), OIIO::TypeDesc(OIIO::TypeDesc::INT8)}) {
        write_image(folder / "n.tif", {{make_spec(8, 4, {"R", "G", "B"}, type), texel}});
        const Image normals = load_texture(folder / "n.tif", ImageUse::normal);
        EXPECT_NEAR(normals.at(1, 0, 0), 0.8, 0.01);  // as (n + 1) / 2
        EXPECT_NEAR(normals.at(0, 0, 0), 0.2, 0.01);
        EXPECT_NEAR(normals.at(0, 0, 1), 0.5, 0.01);
        EXPECT_NEAR(normals.at(0, 0, 2), 0.9, 0.01);
        EXPECT_NEAR(load_slopes(folder / "n.tif", Encoding::automatic, SlopeUnit::texture).at(0, 0, 0), -0.6, 0.01);
        EXPECT_NEAR(load_texture(folder / "n.tif", ImageUse::object_normal).at(0, 0, 0), -0.6, 0.01);
    }
}

TEST(FewDigits, OfATruncatedDpxAreNoZeros) {
    const TempFolder folder;
    auto spec = make_spec(64, 64, {"R", "G", "B"}, OIIO::TypeUInt16);
    spec.attribute("oiio:BitsPerSample", 10);
    write_image(folder / "a.dpx", {{spec, [](int, int x, int) { return static_cast<float>(x) / 64; }}});
    EXPECT_EQ(load_texture(folder / "a.dpx", ImageUse::scalar).width, 64);
    std::filesystem::resize_file(folder / "a.dpx", std::filesystem::file_size(folder / "a.dpx") - 500);
    expect_mentions(error_of([&] { load_texture(folder / "a.dpx", ImageUse::scalar); }), {"the DPX is truncated"});
}

TEST(FewDigits, TilesFarApartWouldTakeMemory) {
    const TempFolder folder;
    for (const char* tile : {"t.1001.exr", "t.1990.exr"}) write_exr(folder / tile, 4096, 64, {"Y"});
    ::setenv("WRINKLE_MEMORY", "0.5", 1);
    const std::string text =
        error_of([&] { load_bump({.file = folder / "t.<UDIM>.exr", .content = Content::height}); });
    ::unsetenv("WRINKLE_MEMORY");
    expect_mentions(text, {"t.<UDIM>.exr", "10 x 99 tiles from 1001 on", "WRINKLE_MEMORY is 500 MB"});
}

}  // namespace
}  // namespace wrinkle
