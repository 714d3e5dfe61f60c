#include <webp/encode.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "io/texture_file.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

/// A lossless picture of 3 x 2 texels, some of them transparent.
std::string webp_with_alpha() {
    std::vector<std::uint8_t> rgba;
    for (int texel = 0; texel < 6; ++texel)
        for (const int value : {40 * texel, 200 - 30 * texel, 250, texel % 2 == 0 ? 0 : 128})
            rgba.push_back(static_cast<std::uint8_t>(value));
    // WebPEncodeLosslessRGBA() clears the colour under transparent texels, which may be what a texture is about.
    WebPConfig config;
    WebPPicture picture;
    WebPMemoryWriter writer;
    EXPECT_NE(WebPConfigInit(&config), 0);
    EXPECT_NE(WebPPictureInit(&picture), 0);
    WebPMemoryWriterInit(&writer);
    config.lossless = config.exact = 1;
    picture.use_argb = 1, picture.width = 3, picture.height = 2;
    picture.writer = WebPMemoryWrite, picture.custom_ptr = &writer;
    EXPECT_NE(WebPPictureImportRGBA(&picture, rgba.data(), 4 * 3), 0);
    EXPECT_NE(WebPEncode(&config, &picture), 0);
    const std::string bytes(reinterpret_cast<const char*>(writer.mem), writer.size);
    WebPPictureFree(&picture);
    WebPMemoryWriterClear(&writer);
    return bytes;
}

TEST(WebpFile, ColoursAreNotMultipliedByAlpha) {
    TempFolder folder;
    std::ofstream(folder / "n.webp", std::ios::binary) << webp_with_alpha();
    const Image image = load_texture(folder / "n.webp", ImageUse::normal);
    ASSERT_EQ(image.width, 3);
    ASSERT_EQ(image.height, 2);
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 2; ++y) {
            const int texel = x + 3 * (1 - y);  // the bottom row comes first
            EXPECT_FLOAT_EQ(image.at(x, y, 0), static_cast<float>(40 * texel) / 255.0f);
            EXPECT_FLOAT_EQ(image.at(x, y, 1), static_cast<float>(200 - 30 * texel) / 255.0f);
            EXPECT_FLOAT_EQ(image.at(x, y, 2), 250.0f / 255.0f);
        }
    EXPECT_FLOAT_EQ(load_texture(folder / "n.webp", ImageUse::scalar).at(1, 1, 0), 40.0f / 255.0f);
}

TEST(WebpFile, TruncatedIsRefused) {
    TempFolder folder;
    const std::string bytes = webp_with_alpha();
    std::ofstream(folder / "n.webp", std::ios::binary) << bytes.substr(0, bytes.size() - 8);
    expect_mentions(error_of([&] { load_texture(folder / "n.webp", ImageUse::normal); }), {"n.webp", "damaged"});
}

}  // namespace
}  // namespace wrinkle
