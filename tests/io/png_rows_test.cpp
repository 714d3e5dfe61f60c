#include "io/png_rows.h"

#include "io/image_writer.h"
#include "tests/io/picture_bands.h"

namespace wrinkle {
namespace {

using namespace test;

/// Reads all numbers of a picture by OpenImageIO, which uses libpng.
std::vector<std::uint16_t> read_by_libpng(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) return {};
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<std::uint16_t> numbers(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeUInt16, numbers.data())) << input->geterror();
    return numbers;
}

TEST(PngRows, LibpngReadsWhatIsWritten) {
    const TempFolder folder;
    for (const int bits : {8, 16})
        for (const int channels : {1, 3, 4}) {
            std::vector<std::vector<float>> planes(static_cast<std::size_t>(channels));
            for (std::size_t c = 0; c < planes.size(); ++c)
                for (std::uint32_t i = 0; i < width * height; ++i)
                    planes[c].push_back(c == 3 ? 1.0f : static_cast<float>((i * (c + 3) + i / width) % 256) / 255);
            ImageOptions options;
            options.png = PngEncoding::linear;
            options.png_bits = bits;
            ImageWriter writer(folder / "o.png", {width, height}, std::vector<std::string>(planes.size(), "Y"),
                               options);
            for (const auto& [begin, end] : {std::pair{0u, 3u}, {3u, 36u}, {36u, 36u}, {36u, height}})
                write_band(writer, planes, begin, end);
            writer.finish();
            const auto numbers = read_by_libpng(folder / "o.png");
            ASSERT_EQ(numbers.size(), std::size_t{width} * height * planes.size()) << bits << " " << channels;
            for (std::size_t i = 0; i < numbers.size(); ++i)
                ASSERT_EQ(numbers[i], std::lround(planes[i % planes.size()][i / planes.size()] * 65535))
                    << bits << " bits, " << channels << " channels, number " << i;
        }
}

TEST(PngRows, HoldsTheirProvenanceAndTheirCurve) {
    const TempFolder folder;
    ImageOptions options;
    options.provenance = "of this";
    ImageWriter writer(folder / "o.png", {width, height}, {"R", "G", "B"}, options);
    write_band(writer, planes_of(3), 0, height);
    writer.finish();
    const auto input = OIIO::ImageInput::open((folder / "o.png").string());
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
    EXPECT_EQ(input->spec().get_string_attribute("wrinkle/provenance"), "of this");
}

}  // namespace
}  // namespace wrinkle
