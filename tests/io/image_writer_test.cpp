#include "io/image_writer.h"

#include <bit>
#include <cmath>
#include <limits>

#include "tests/io/picture_bands.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

TEST(ImageWriter, BandsOfAnySizeMakeTheSameFile) {
    TempFolder folder;
    const auto planes = planes_of(4);
    ImageOptions options;
    options.metadata.set("wrinkle:scene", "a scene");
    ImageWriter writer(folder / "out.exr", {width, height}, {"normal.x", "normal.y", "normal.z", "marked"}, options);
    for (const auto& [begin, end] : {std::pair{0u, 1u}, {1u, 33u}, {33u, 33u}, {33u, height}}) {
        write_band(writer, planes, begin, end);
    }
    EXPECT_TRUE(folder.files().empty()) << "nothing is seen before finish()";
    writer.finish();
    EXPECT_EQ(folder.files(), Names{"out.exr"});
    EXPECT_EQ(read_channel(folder / "out.exr", "normal.y"), planes[1]);
    EXPECT_EQ(read_channel(folder / "out.exr", "marked"), planes[3]);
    EXPECT_EQ(GBufferReader(folder / "out.exr").metadata().text("wrinkle:scene"), "a scene");
    EXPECT_EQ(GBufferReader(folder / "out.exr").metadata().text("compression"), "zip");
}

TEST(ImageWriter, MetadataOfTheInputIsCopiedButNotItsStorage) {
    // OpenImageIO renames V-Ray's cameraTransform on reading and again on writing.
    for (const std::string camera : {"worldToCamera", "cameraTransform"}) {
        TempFolder folder;
        auto spec = make_spec(4, 4, {"Z"});
        const float values[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1};
        spec.attribute(camera, OIIO::TypeMatrix44, values);
        spec.attribute("compression", "piz");
        spec.attribute("Scene", "courtyard");
        write_image(folder / "in.exr", {{spec}});
        ImageOptions options;
        options.metadata = GBufferReader(folder / "in.exr").metadata();
        ImageWriter writer(folder / "out.exr", {4, 4}, {"Z"}, options);
        const std::vector<float> plane(16, 1.0f);
        const float* planes[] = {plane.data()};
        writer.write_rows(0, 4, planes);
        writer.finish();
        const auto metadata = GBufferReader(folder / "out.exr").metadata();
        EXPECT_EQ(metadata.text("compression"), "zip");
        EXPECT_EQ(metadata.text("Scene"), "courtyard");
        const auto matrix = metadata.matrix(camera);
        ASSERT_TRUE(matrix) << camera;
        EXPECT_EQ((*matrix)[3][1], 5) << camera;
    }
}

TEST(ImageWriter, HalfKeepsFiniteValuesFiniteAndCryptomattesWhole) {
    TempFolder folder;
    const float id = std::bit_cast<float>(0xf9fa0452u);
    const std::vector<float> depth{1e10f, -1e10f, std::numeric_limits<float>::infinity(), 0.25f}, ids(4, id);
    ImageOptions options;
    options.half = true;
    ImageWriter writer(folder / "half.exr", {2, 2}, {"Z", "CryptoObject00.R"}, options);
    const float* planes[] = {depth.data(), ids.data()};
    writer.write_rows(0, 2, planes);
    writer.finish();
    EXPECT_EQ(read_channel(folder / "half.exr", "Z"),
              (std::vector<float>{65504, -65504, std::numeric_limits<float>::infinity(), 0.25f}));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(read_channel(folder / "half.exr", "CryptoObject00.R")[3]), 0xf9fa0452u);
}

TEST(ImageWriter, PngEncodings) {
    TempFolder folder;
    const auto encode = [&](PngEncoding encoding, double exposure, std::vector<float> values) {
        ImageOptions options;
        options.png = encoding;
        options.exposure = exposure;
        ImageWriter writer(folder / "p.png", {static_cast<std::uint32_t>(values.size()), 1}, {"R", "G", "B"}, options);
        const float* planes[] = {values.data(), values.data(), values.data()};
        writer.write_rows(0, 1, planes);
        writer.finish();
        std::vector<int> bytes;
        for (const float value : read_channel(folder / "p.png", "G"))
            bytes.push_back(static_cast<int>(std::lround(value * 255)));
        return bytes;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(encode(PngEncoding::srgb, 0, {0, 0.5f, 1, 7, -1, nan, inf}), (std::vector{0, 188, 255, 255, 0, 0, 255}));
    EXPECT_EQ(encode(PngEncoding::srgb, 1, {0.25f}), std::vector{188});
    EXPECT_EQ(encode(PngEncoding::linear, 3, {0.2f, 2}), (std::vector{51, 255}));
    EXPECT_EQ(encode(PngEncoding::normal, 0, {-1, 0.2f, 1}), (std::vector{0, 153, 255}));
}

TEST(ImageWriter, PngRowsAreTopFirst) {
    TempFolder folder;
    ImageOptions options;
    options.png = PngEncoding::linear;
    ImageWriter writer(folder / "p.png", {1, 2}, {"Y"}, options);
    const float values[] = {1, 0};
    const float* planes[] = {values};
    writer.write_rows(0, 2, planes);
    writer.finish();
    EXPECT_EQ(read_channel(folder / "p.png", "Y"), (std::vector<float>{1, 0}));
}

TEST(ImageWriter, IntegersAreStoredAsSuch) {
    TempFolder folder;
    for (const bool half : {false, true}) {
        ImageOptions options;
        options.half = half;
        options.whole = {"id"};
        const std::vector<std::uint32_t> numbers{0, 16777217, 4294967295u};
        std::vector<float> bits, values{1, 2.5f, -3};
        for (const std::uint32_t number : numbers) bits.push_back(std::bit_cast<float>(number));
        ImageWriter writer(folder / "o.exr", {3, 1}, {"id", "N.X"}, options);
        const std::vector<const float*> planes{bits.data(), values.data()};
        writer.write_rows(0, 1, planes);
        writer.finish();
        const GBufferReader reader(folder / "o.exr");
        EXPECT_EQ(reader.channel_type("id"), ChannelType::whole);
        EXPECT_EQ(reader.channel_type("N.X"), half ? ChannelType::half : ChannelType::single);
        std::vector<float> read_bits(3), read_values(3);
        const std::vector<std::string> names{"bits:id", "channel:N.X"};
        const std::vector<float*> out{read_bits.data(), read_values.data()};
        reader.read_rows(0, 1, names, out);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(std::bit_cast<std::uint32_t>(read_bits[i]), numbers[i]);
        EXPECT_EQ(read_values, values);
    }
}

TEST(ImageWriter, OverscanIsKeptInExrAndCutOffInPng) {
    TempFolder folder;
    ImageOptions options;
    options.window = FrameWindow{-1, -2, {3, 2}};
    options.png = PngEncoding::linear;
    std::vector<float> pixels;
    for (int i = 0; i < 6 * 5; ++i) pixels.push_back(static_cast<float>(i) / 32);
    for (const char* name : {"o.exr", "o.png"}) {
        ImageWriter writer(folder / name, {6, 5}, {"Y"}, options);
        for (std::uint32_t row = 0; row < 5; ++row) {
            const std::vector<const float*> planes{pixels.data() + 6 * row};
            writer.write_rows(row, row + 1, planes);
        }
        writer.finish();
        auto input = OIIO::ImageInput::open((folder / name).string());
        ASSERT_TRUE(input);
        const auto& spec = input->spec();
        const bool exr = std::string(name) == "o.exr";
        EXPECT_EQ(spec.width, exr ? 6 : 3);
        EXPECT_EQ(spec.height, exr ? 5 : 2);
        EXPECT_EQ(spec.x, exr ? -1 : 0);
        EXPECT_EQ(spec.y, exr ? -2 : 0);
        EXPECT_EQ(spec.full_width, 3);
        std::vector<float> read(static_cast<std::size_t>(spec.width * spec.height));
        ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeFloat, read.data()));
        EXPECT_NEAR(read[0], exr ? pixels[0] : pixels[2 * 6 + 1], 1e-2);
        EXPECT_NEAR(read.back(), exr ? pixels.back() : pixels[3 * 6 + 3], 1e-2);
    }
}

}  // namespace
}  // namespace wrinkle
