#include "look/look_picture.h"

#include <gtest/gtest.h>
#include <webp/decode.h>

#include "wrinkle/error.h"
#include "wrinkle/gbuffer.h"

namespace wrinkle {
namespace {

/// Red, green and blue of a pixel of the picture as a page that is made smaller shows it.
std::array<int, 3> pixel_of(const LookImage& image, const std::string& name, std::uint32_t longest, int x, int y) {
    const std::string file = webp_of(image, name, longest);
    int width = 0, height = 0;
    const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> rgb(
        WebPDecodeRGB(reinterpret_cast<const std::uint8_t*>(file.data()), file.size(), &width, &height), &WebPFree);
    if (!rgb || width != static_cast<int>(longest)) throw Error(name + " was not packed as a picture so wide");
    const std::uint8_t* const at = rgb.get() + 3 * (y * width + x);
    return {at[0], at[1], at[2]};
}

LookImage image_of(std::map<std::string, std::vector<float>> planes) {
    LookImage image{.size = {8, 4}, .frame = std::make_shared<const WholePlanes>()};
    for (auto& [name, values] : planes) image.out[name] = std::move(values);
    return image;
}

TEST(LookPicture, ASingleMarkStaysWhenAPictureIsShrunk) {
    std::vector<float> marked(32, 0);
    marked[8 + 3] = static_cast<float>(Marked::overflow);
    marked[2 * 8 + 6] = static_cast<float>(Marked::invalid);
    const LookImage image = image_of({{"marked", marked}});
    EXPECT_EQ(pixel_of(image, "marked", 4, 1, 0), (std::array{0xd0, 0x40, 0x40}));
    EXPECT_EQ(pixel_of(image, "marked", 4, 3, 1), (std::array{0x3a, 0x3a, 0x44}));
    EXPECT_EQ(pixel_of(image, "marked", 4, 0, 0), (std::array{0, 0, 0}));
}

TEST(LookPicture, OthersShrinkToMeans) {
    std::vector<float> rough(32, 0);
    for (const std::size_t at : {0, 1, 8}) rough[at] = 0.8f;
    const auto [r, g, b] = pixel_of(image_of({{"roughness", rough}}), "roughness", 4, 0, 0);
    EXPECT_NEAR(r, 0.6 * 255, 16);  // it is packed with loss
    EXPECT_NEAR(g, r, 2);
    EXPECT_NEAR(b, r, 2);
}

}  // namespace
}  // namespace wrinkle
