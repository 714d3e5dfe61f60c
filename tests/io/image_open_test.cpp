#include "base/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <thread>

#include "io/gbuffer_reader.h"
#include "io/image_open.h"
#include "io/texture_file.h"
#include "tests/io/files.h"
#include "tests/io/odd_exr.h"

namespace wrinkle {
namespace {

using namespace test;

TEST(InputFile, StaysWhatWasOpened) {
    const TempFolder folder;
    write_text(folder / "a", "first");
    const InputFile file(folder / "a");
    write_text(folder / "b", "the second, which is longer");
    std::filesystem::rename(folder / "b", folder / "a");
    EXPECT_EQ(file.read_all(), "first");
    EXPECT_EQ(file.size(), 5u);
    char end[8];
    EXPECT_EQ(file.read_at(3, end, sizeof end), 2u);
    EXPECT_EQ(file.read_at(100, end, sizeof end), 0u);
}

TEST(InputFile, IsARegularOne) {
    const TempFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    expect_mentions(error_of([&] { InputFile(folder / "pipe", "a scene"); }),
                    {"pipe: cannot be read: it is a pipe; a scene was expected"});
    expect_mentions(error_of([] { InputFile("/dev/zero"); }), {"it is a device"});
    expect_mentions(error_of([&] { load_texture(folder / "pipe", ImageUse::scalar); }), {"it is a pipe"});
}

/// A renderer that writes frames anew replaces them by rename. Whoever reads meanwhile gets the one or the other.
TEST(InputFile, FramesMayBeReplacedWhileTheyAreRead) {
    const TempFolder folder;
    const auto frame = [](int width) {
        ExrHeader header;
        header.data[2] = header.display[2] = width - 1;
        return exr_file(header, static_cast<std::size_t>(width));
    };
    const std::string narrow = frame(16), wide = frame(8192);
    write_text(folder / "f.exr", narrow);
    std::atomic<bool> done = false;
    std::thread writer([&] {
        for (int i = 0; !done; ++i) {
            write_text(folder / "next", i % 2 != 0 ? narrow : wide);
            std::filesystem::rename(folder / "next", folder / "f.exr");
        }
    });
    for (int i = 0; i < 200; ++i) {
        const GBufferReader reader(folder / "f.exr");
        const auto [width, height] = reader.size();
        EXPECT_TRUE(width == 16 || width == 8192) << width;
        std::vector<float> values(std::size_t{width} * height, 1);
        float* out[] = {values.data()};
        reader.read_rows(0, height, std::vector<std::string>{"depth"}, out);
        EXPECT_EQ(values.back(), 0);
    }
    done = true;
    writer.join();
}

/// By what is in it, not by its name, and always through the one descriptor.
TEST(ImageOpen, KnowsFormatsByTheirBytes) {
    const TempFolder folder;
    for (const char* name :
         {"a.png", "a.tif", "a.exr", "a.jpg", "a.bmp", "a.hdr", "a.tga", "a.webp", "a.dpx", "a.ppm"}) {
        const bool is_float = std::string_view(name).ends_with("exr") || std::string_view(name).ends_with("hdr");
        auto spec = make_spec(16, 16, {"R", "G", "B"}, is_float ? OIIO::TypeFloat : OIIO::TypeUInt8);
        write_image(folder / name, {{spec, [](int, int, int) { return 0.5F; }}});
        const Image image = load_texture(folder / name, ImageUse::scalar);
        EXPECT_NEAR(image.texels.at(40), 0.5F, 0.02F) << name;
        if (std::string_view(name) == "a.tga") continue;  // which has no magic bytes
        std::filesystem::rename(folder / name, folder / "misnamed.txt");
        EXPECT_EQ(load_texture(folder / "misnamed.txt", ImageUse::scalar).texels, image.texels) << name;
    }
}

TEST(ImageOpen, NoPixelsAreNoImage) {
    const TempFolder folder;
    write_text(folder / "empty.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 2\nabcd");
    expect_mentions(error_of([&] { load_texture(folder / "empty.hdr", ImageUse::scalar); }),
                    {"empty.hdr: 2 x 0 pixels", "there is nothing in it"});
}

/// The header of a lossy WebP of 16383 x 16383 pixels, and little more.
TEST(ImageOpen, WebpIsAskedBeforeItIsDecoded) {
    const TempFolder folder;
    const std::string frame = std::string("\x10\x00\x00\x9d\x01\x2a\xff\x3f\xff\x3f", 10) + std::string(118, '\x55');
    const std::string body = "WEBPVP8 " + std::string("\x80\x00\x00\x00", 4) + frame;
    write_text(folder / "huge.webp", "RIFF" + std::string("\x8c\x00\x00\x00", 4) + body);
    expect_mentions(error_of([&] { load_texture(folder / "huge.webp", ImageUse::scalar); }),
                    {"huge.webp: it claims a picture of 16383x16383 pixels", "in a file of"});
}

/// Whose header claims a row of gigabytes.
TEST(ImageOpen, DpxIsAskedBeforeItIsOpened) {
    const TempFolder folder;
    std::string bytes(2048, '\0');
    constexpr std::size_t kSizeAt = 16, kWidthAt = 772, kHeightAt = 776;
    bytes.replace(0, 4, "SDPX").replace(kSizeAt, 4, 4, '\xff').replace(kWidthAt, 4, 4, '\x7f');
    bytes[kHeightAt + 3] = 1;
    write_text(folder / "wide.dpx", bytes);
    expect_mentions(error_of([&] { load_texture(folder / "wide.dpx", ImageUse::scalar); }),
                    {"wide.dpx: it claims a picture of 2139062143x1 pixels", "in a file of"});
    constexpr std::size_t kUserDataAt = 32;
    bytes.replace(kUserDataAt, 4, 4, '\x7f');
    write_text(folder / "user.dpx", bytes);
    expect_mentions(error_of([&] { load_texture(folder / "user.dpx", ImageUse::scalar); }),
                    {"user.dpx: the DPX is truncated: 2048 bytes of 2139062143"});
}

TEST(ImageOpen, DisplaysAreNoMemoryEither) {
    const TempFolder folder;
    auto spec = make_spec(16, 16, {"Y"}, OIIO::TypeUInt8);
    for (const int side : {4096, 100'000}) {
        spec.full_width = spec.full_height = side;
        write_image(folder / "a.tif", {{spec, [](int, int, int) { return 0.5F; }}});
        const auto load = [&] { load_texture(folder / "a.tif", ImageUse::scalar); };
        if (side == 4096)
            EXPECT_NO_THROW(load());
        else
            expect_mentions(error_of(load), {"a.tif: it claims a picture of 100000x100000 pixels", "in a file of"});
    }
}

/// Few bytes that claim 65535 x 65535 pixels, or rows so long that reading some at a time takes as much.
TEST(ImageOpen, ClaimsAreNoMemory) {
    const TempFolder folder;
    auto spec = make_spec(16, 16, {"Y"}, OIIO::TypeUInt8);
    write_image(folder / "a.png", {{spec, [](int, int, int) { return 0.5F; }}});
    std::ifstream in(folder / "a.png", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    constexpr std::size_t kWidthAt = 16, kHeaderAt = 12, kHeaderBytes = 17;
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i) & 0xff);
    };
    for (const auto& [width, height, memory] : {std::tuple{65535U, 65535U, "17.2 GB"}, {900000U, 4U, "461 MB"}}) {
        put(kWidthAt, width), put(kWidthAt + 4, height);
        put(kHeaderAt + kHeaderBytes, static_cast<std::uint32_t>(crc32(
                                          0, reinterpret_cast<const Bytef*>(bytes.data()) + kHeaderAt, kHeaderBytes)));
        write_text(folder / "huge.png", bytes);
        expect_mentions(
            error_of([&] { load_texture(folder / "huge.png", ImageUse::scalar); }),
            {fmt::format("huge.png: it claims a picture of {}x{} pixels", width, height), memory, "in a file of"});
    }
}

}  // namespace
}  // namespace wrinkle
