#include "io/exr_blocks.h"

#include <random>

#include "io/image_writer.h"
#include "tests/io/picture_bands.h"

namespace wrinkle {
namespace {

using namespace test;

/// Reads a channel by OpenImageIO, which uses OpenEXR's own decompressor.
std::vector<float> read_by_openexr(const std::filesystem::path& file, const std::string& channel) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return {};
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<float> pixels(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    const int c = spec.channelindex(channel);
    EXPECT_TRUE(input->read_scanlines(0, 0, spec.y, spec.y + spec.height, 0, c, c + 1, OIIO::TypeFloat, pixels.data()))
        << input->geterror();
    return pixels;
}

TEST(ExrBlocks, OpenExrReadsWhatIsWritten) {
    const TempFolder folder;
    const auto planes = planes_of(3);
    for (const Compression compression : {Compression::zip, Compression::zips, Compression::none})
        for (const bool half : {false, true}) {
            ImageOptions options;
            options.compression = compression;
            options.half = half;
            options.full = {"b"};
            ImageWriter writer(folder / "o.exr", {width, height}, {"c", "a", "b"}, options);
            for (const auto& [begin, end] : {std::pair{0u, 3u}, {3u, 4u}, {4u, 16u}, {16u, 49u}, {49u, height}})
                write_band(writer, planes, begin, end);
            writer.finish();
            EXPECT_EQ(read_by_openexr(folder / "o.exr", "b"), planes[2]);
            const auto c = read_by_openexr(folder / "o.exr", "c");
            ASSERT_EQ(c.size(), planes[0].size());
            for (std::size_t i = 0; i < c.size(); ++i)
                EXPECT_NEAR(c[i], planes[0][i], half ? std::abs(planes[0][i]) / 1024 : 0);
            EXPECT_EQ(read_channel(folder / "o.exr", "b"), planes[2]);
        }
}

TEST(ExrBlocks, WhatDoesNotCompressIsStored) {
    const TempFolder folder;
    std::mt19937 random(1);
    std::vector<float> plane(std::size_t{width} * height);
    for (float& value : plane) value = std::bit_cast<float>(static_cast<std::uint32_t>(random() & 0x7f7fffffu));
    ImageWriter writer(folder / "noise.exr", {width, height}, {"Z"});
    const float* planes[] = {plane.data()};
    writer.write_rows(0, height, planes);
    writer.finish();
    EXPECT_EQ(read_by_openexr(folder / "noise.exr", "Z"), plane);
    EXPECT_LT(std::filesystem::file_size(folder / "noise.exr"), plane.size() * sizeof(float) + 1000);
}

TEST(ExrBlocks, FilesAreAsLargeAsOpenExrMakesThem) {
    const TempFolder folder;
    constexpr std::uint32_t side = 256;
    std::vector<float> plane(std::size_t{side} * side);
    for (std::size_t i = 0; i < plane.size(); ++i)
        plane[i] = std::sin(static_cast<float>(i % side) / 31) * std::cos(static_cast<float>(i / side) / 17);
    ImageWriter writer(folder / "ours.exr", {side, side}, {"Z"});
    const float* planes[] = {plane.data()};
    writer.write_rows(0, side, planes);
    writer.finish();
    write_exr(folder / "theirs.exr", side, side, {"Z"}, [&](int, int x, int y) {
        return plane[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)];
    });
    EXPECT_LT(static_cast<double>(std::filesystem::file_size(folder / "ours.exr")),
              1.03 * static_cast<double>(std::filesystem::file_size(folder / "theirs.exr")));
}

}  // namespace
}  // namespace wrinkle
