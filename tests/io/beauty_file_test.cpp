// A beauty in a file of its own that has fewer pixels than the frame.
#include "io/beauty_file.h"

#include "tests/io/read_planes.h"

namespace wrinkle::test {
namespace {

void write(const std::filesystem::path& file, int width, int height, std::vector<std::string> channels, int x = 0,
           int y = 0, int display_width = 0, int display_height = 0) {
    OIIO::ImageSpec spec = make_spec(width, height, std::move(channels));
    spec.x = x, spec.y = y;
    spec.full_width = display_width != 0 ? display_width : width;
    spec.full_height = display_height != 0 ? display_height : height;
    write_image(file, {{spec}});
}

std::string refusal(const std::filesystem::path& file, const GBufferSource& source) {
    try {
        GBufferReader(file, source);
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

TEST(BeautyFile, PixelsOfASmallerOneAreRepeated) {
    const TempFolder folder;
    const std::vector<std::string> normals{"N.X", "N.Y", "N.Z", "key.R"};
    write(folder / "data.exr", 12, 9, normals);
    write(folder / "beauty.exr", 4, 3, {"R", "G", "B", "A", "key.R", "sun.R", "sun.G", "sun.B"});
    GBufferSource source;
    source.beauty_file = folder / "beauty.exr";
    const GBufferReader reader(folder / "data.exr", source);
    EXPECT_EQ(reader.beauty_scale(), 3u);
    const std::vector<std::string> names{"beauty.g", "normal.x", "beauty.a", "channel:sun.B", "channel:key.R"};
    const int channel[] = {1, 0, 3, 7, 3};
    for (const auto& [begin, end] : {std::pair{0u, 9u}, {2u, 7u}, {4u, 5u}, {8u, 9u}}) {
        const auto planes = read(reader, begin, end, names);
        for (std::size_t k = 0; k < names.size(); ++k)
            for (std::uint32_t y = begin; y < end; ++y)
                for (int x = 0; x < 12; ++x) {
                    const bool own = names[k] == "normal.x" || names[k] == "channel:key.R";
                    const int step = own ? 1 : 3;
                    EXPECT_EQ(planes[k][(y - begin) * 12 + static_cast<std::size_t>(x)],
                              numbered(channel[k], x / step, static_cast<int>(y) / step))
                        << names[k] << " at " << x << ", " << y;
                }
    }
    EXPECT_EQ(GBufferReader(folder / "data.exr").beauty_scale(), 1u);
}

TEST(BeautyFile, MustHaveAWholeShareOfTheFramesPixels) {
    const TempFolder folder;
    write(folder / "data.exr", 12, 8, {"N.X", "N.Y", "N.Z"});
    GBufferSource source;
    source.beauty_file = folder / "beauty.exr";
    for (const auto& [width, height] : {std::pair{5, 4}, {6, 8}, {4, 4}, {24, 16}, {12, 7}}) {
        write(folder / "beauty.exr", width, height, {"R", "G", "B"});
        const std::string text = refusal(folder / "data.exr", source);
        for (const std::string& part :
             {std::string("beauty.exr: the beauty has ") + std::to_string(width) + "x" + std::to_string(height),
              std::string("12x8"), std::string("whole multiple")})
            EXPECT_NE(text.find(part), std::string::npos) << text;
    }
    write(folder / "wide.exr", 68, 34, {"N.X", "N.Y", "N.Z"});
    write(folder / "beauty.exr", 4, 2, {"R", "G", "B"});
    EXPECT_NE(refusal(folder / "wide.exr", source).find("up to 16"), std::string::npos);
    source.overscan = true;
    write(folder / "data.exr", 12, 8, {"N.X", "N.Y", "N.Z"}, -2, -2, 8, 4);
    write(folder / "beauty.exr", 6, 4, {"R", "G", "B"}, -1, -1, 4, 2);
    EXPECT_EQ(GBufferReader(folder / "data.exr", source).beauty_scale(), 2u);
    write(folder / "beauty.exr", 6, 4, {"R", "G", "B"}, -2, -1, 4, 2);
    EXPECT_NE(refusal(folder / "data.exr", source).find("whole multiple"), std::string::npos);
    write(folder / "data.exr", 12, 8, {"N.X", "N.Y", "N.Z"}, -2, -2, 9, 4);
    write(folder / "beauty.exr", 6, 4, {"R", "G", "B"}, -1, -1, 4, 2);
    const std::string text = refusal(folder / "data.exr", source);
    for (const char* part : {"beauty.exr: the display window of the beauty has 4x2", "data.exr has 9x4", "2 times"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(BeautyFile, ChannelsThatNeitherFileHasAreSaidOfBoth) {
    const TempFolder folder;
    write(folder / "data.exr", 12, 8, {"N.X", "N.Y", "N.Z"});
    write(folder / "beauty.exr", 6, 4, {"R", "G", "B", "sun.R", "sun.G", "sun.B"});
    GBufferSource source;
    source.beauty_file = folder / "beauty.exr";
    try {
        GBufferReader(folder / "data.exr", source).require(std::vector<std::string>{"channel:sun.r"});
        ADD_FAILURE() << "nothing was refused";
    } catch (const Error& error) {
        const std::string text = error.what();
        for (const char* part : {"data.exr", "beauty.exr", "no channel \"sun.r\"", "nearest: \"sun.", "N.XYZ"})
            EXPECT_NE(text.find(part), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace wrinkle::test
