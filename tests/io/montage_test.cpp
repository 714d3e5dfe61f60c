#include "io/montage.h"

#include <OpenImageIO/imageio.h>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

TEST(Montage, FillsRowsOfColumns) {
    const TempFolder folder;
    const int width = 30, height = 20, gap = 6, caption = 24;  // as in montage.cpp
    std::vector<std::vector<float>> pictures;
    std::vector<MontagePart> parts;
    for (int i = 0; i < 3; ++i) pictures.emplace_back(static_cast<std::size_t>(3 * width * height), 0.2F * (i + 1));
    for (const auto& rgb : pictures) parts.push_back({{width, height}, rgb, "a"});
    const struct { int columns, across, down; } cases[] = {{0, 3, 1}, {2, 2, 2}, {1, 1, 3}, {9, 3, 1}};
    for (const auto& wanted : cases) {
        write_montage(folder / "sheet.png", parts, wanted.columns);
        const auto input = OIIO::ImageInput::open((folder / "sheet.png").string());
        ASSERT_TRUE(input);
        const OIIO::ImageSpec& spec = input->spec();
        ASSERT_EQ(spec.width, wanted.across * (width + gap) - gap) << wanted.columns;
        ASSERT_EQ(spec.height, wanted.down * (height + caption)) << wanted.columns;
        std::vector<unsigned char> bytes(static_cast<std::size_t>(spec.width * spec.height * 3));
        input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, bytes.data());
        for (int i = 0; i < 3; ++i) {
            const int x = i % wanted.across * (width + gap) + width / 2;
            const int y = i / wanted.across * (height + caption) + height / 2;
            EXPECT_EQ(bytes[static_cast<std::size_t>(3 * (y * spec.width + x))], 51 * (i + 1))
                << wanted.columns << " columns, picture " << i;
        }
    }
}

}  // namespace
}  // namespace wrinkle
