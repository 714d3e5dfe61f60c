#include "io/gbuffer_reader.h"

#include <OpenImageIO/deepdata.h>

#include "tests/io/read_planes.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

int index_of(const std::string& channel) {
    return static_cast<int>(std::ranges::find(blender_channels, channel) - blender_channels.begin());
}

TEST(GBufferReader, ReadsBandsOfTheNamedPlanes) {
    TempFolder folder;
    write_exr(folder / "a.exr", 37, 53, blender_channels);
    const GBufferReader reader(folder / "a.exr");
    EXPECT_EQ(reader.size(), (Size{37, 53}));
    EXPECT_EQ(reader.parts(), 1);
    EXPECT_EQ(reader.roles().writer, Writer::blender);
    for (const auto& [begin, end] : {std::pair{0u, 53u}, {5u, 21u}, {52u, 53u}, {7u, 7u}}) {
        const auto values = read(reader, begin, end, {"normal.y", "depth", "channel:ViewLayer.UV.A"});
        for (std::uint32_t y = begin; y < end; ++y) {
            for (std::uint32_t x = 0; x < 37; ++x) {
                const auto i = (y - begin) * 37 + x;
                const int px = static_cast<int>(x), py = static_cast<int>(y);
                EXPECT_EQ(values[0][i], numbered(index_of("ViewLayer.Normal.Y"), px, py));
                EXPECT_EQ(values[1][i], numbered(index_of("ViewLayer.Depth.Z"), px, py));
                EXPECT_EQ(values[2][i], numbered(index_of("ViewLayer.UV.A"), px, py));
            }
        }
    }
}

TEST(GBufferReader, HalfAndTiledFilesReadTheSame) {
    TempFolder folder;
    auto tiled = make_spec(50, 41, {"N.X", "N.Y", "N.Z", "Z"}, OIIO::TypeHalf);
    tiled.tile_width = tiled.tile_height = 16;
    write_image(folder / "tiled.exr", {{tiled, [](int c, int x, int y) { return numbered(c, x, y) / 4; }}});
    const GBufferReader reader(folder / "tiled.exr");
    const auto values = read(reader, 3, 39, {"normal.z", "depth"});
    for (int y = 3; y < 39; ++y) {
        for (int x = 0; x < 50; ++x) {
            const auto i = static_cast<std::size_t>((y - 3) * 50 + x);
            EXPECT_NEAR(values[0][i], numbered(2, x, y) / 4, 0.05);
            EXPECT_NEAR(values[1][i], numbered(3, x, y) / 4, 0.05);
        }
    }
}

// A band may begin in a block that the band before has read already. Planes may be of one part of the file or of
// several.
TEST(GBufferReader, BandsThatOverlapReadTheSame) {
    using Plane = std::pair<std::string, int>;  // a plane, and the number of its channel within its part
    TempFolder folder;
    const int width = 21, height = 150;
    auto lines = make_spec(width, height, {"N.X", "N.Y", "N.Z", "U", "Z"}), tiles = lines, crop = lines;
    tiles.tile_width = tiles.tile_height = 16;
    crop.y = 9, crop.full_y = 0, crop.full_height = height + 20;
    auto first = make_spec(width, height, {"X", "Y", "Z"}), second = make_spec(width, height, {"depth.U", "depth.Z"});
    first.attribute("oiio:subimagename", "N"), second.attribute("oiio:subimagename", "depth");
    const struct {
        const char* name;
        std::vector<PartSpec> parts;
        Plane depth, other;
    } files[] = {{"lines.exr", {{lines}}, {"depth", 4}, {"channel:U", 3}},
                 {"tiles.exr", {{tiles}}, {"depth", 4}, {"channel:U", 3}},
                 {"crop.exr", {{crop}}, {"depth", 4}, {"channel:U", 3}},
                 {"parts.exr", {{first}, {second}}, {"depth", 1}, {"channel:depth.U", 0}}};
    for (const auto& file : files) {
        write_image(folder / file.name, file.parts);
        const GBufferReader reader(folder / file.name);
        const int top = file.parts.front().spec.y;
        const auto expect = [&](int begin, int end, const std::vector<Plane>& planes) {
            Names names;
            for (const Plane& plane : planes) names.push_back(plane.first);
            const auto values = read(reader, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end), names);
            for (std::size_t p = 0; p < planes.size(); ++p)
                for (int y = begin, i = 0; y < end; ++y)
                    for (int x = 0; x < width; ++x, ++i) {
                        const bool inside = y >= top && y < top + height;
                        ASSERT_EQ(values[p][static_cast<std::size_t>(i)],
                                  inside ? numbered(planes[p].second, x, y - top) : 0.0f)
                            << file.name << ", rows " << begin << " to " << end << ", " << names[p] << ", row " << y;
                    }
        };
        const Plane normal{"normal.z", 2};
        for (int band = 0; band < height; band += 32)
            expect(std::max(band - 1, 0), std::min(band + 33, height), {normal, file.depth});
        expect(40, 50, {normal, file.depth});      // backwards, and within the rows read before
        expect(48, 49, {file.depth, file.other});  // other channels
        expect(47, 100, {normal});
        expect(98, 150, {normal});
        const Plane other_axes[] = {{"normal.x", 0}, {"normal.y", 1}};
        expect(20, 30, {other_axes[0], normal});  // channels that lie among those read before, but were not wanted then
        expect(28, 40, {other_axes[0], other_axes[1], normal});
    }
}

TEST(GBufferReader, ChannelsOverSeveralParts) {
    TempFolder folder;
    auto first = make_spec(20, 10, {"R", "G", "B"}), second = make_spec(20, 10, {"X", "Y", "Z"}),
         third = make_spec(20, 10, {"depth.Z"});
    first.attribute("oiio:subimagename", "rgba");
    second.attribute("oiio:subimagename", "N");
    third.attribute("oiio:subimagename", "depth");
    write_image(folder / "parts.exr",
                {{first}, {second}, {third, [](int, int x, int y) { return numbered(7, x, y); }}});
    const GBufferReader reader(folder / "parts.exr");
    EXPECT_EQ(reader.parts(), 3);
    EXPECT_EQ(reader.channels(), (Names{"R", "G", "B", "N.X", "N.Y", "N.Z", "depth.Z"}));
    const auto values = read(reader, 2, 9, {"beauty.g", "normal.z", "depth"});
    EXPECT_EQ(values[0][20 * 3 + 4], numbered(1, 4, 5));
    EXPECT_EQ(values[1][20 * 3 + 4], numbered(2, 4, 5));
    EXPECT_EQ(values[2][20 * 3 + 4], numbered(7, 4, 5));
}

TEST(GBufferReader, PixelsOutsideTheDataWindowAreBackground) {
    TempFolder folder;
    auto spec = make_spec(10, 8, {"N.X", "N.Y", "N.Z"});
    // The frame begins at (100, 200): data begins 5 right and 3 below, and 3 columns are outside of it.
    spec.x = 105, spec.y = 203;
    spec.full_x = 100, spec.full_y = 200, spec.full_width = 12, spec.full_height = 20;
    write_image(folder / "crop.exr", {{spec}});
    const GBufferReader reader(folder / "crop.exr");
    ASSERT_EQ(reader.size(), (Size{12, 20}));
    const auto plane = read(reader, 1, 20, {"normal.y"})[0];
    for (int y = 1; y < 20; ++y) {
        for (int x = 0; x < 12; ++x) {
            const bool inside = x >= 5 && y >= 3 && y < 11;
            EXPECT_EQ(plane[static_cast<std::size_t>((y - 1) * 12 + x)], inside ? numbered(1, x - 5, y - 3) : 0.0f);
        }
    }
}

TEST(GBufferReader, OverscanBelongsToTheFrameWhereItIsWanted) {
    TempFolder folder;
    auto spec = make_spec(14, 12, {"N.X", "N.Y", "N.Z"});
    spec.x = 97, spec.y = 198;
    spec.full_x = 100, spec.full_y = 200, spec.full_width = 10, spec.full_height = 20;
    write_image(folder / "over.exr", {{spec}});
    EXPECT_EQ(GBufferReader(folder / "over.exr").size(), (Size{10, 20}));
    GBufferSource source;
    source.overscan = true;
    const GBufferReader reader(folder / "over.exr", source);
    EXPECT_EQ(reader.size(), (Size{14, 22}));
    EXPECT_EQ(reader.window().x, -3);
    EXPECT_EQ(reader.window().y, -2);
    EXPECT_EQ(reader.window().display, (Size{10, 20}));
    const auto plane = read(reader, 0, 22, {"normal.y"})[0];
    EXPECT_EQ(plane[0], numbered(1, 0, 0));
    EXPECT_EQ(plane[11 * 14 + 13], numbered(1, 13, 11));
    EXPECT_EQ(plane[12 * 14], 0);
}

TEST(GBufferReader, TheBeautyMayBeAnotherFiles) {
    TempFolder folder;
    write_exr(folder / "data.exr", 8, 6, {"N.X", "N.Y", "N.Z", "R", "G", "B"});
    write_exr(folder / "beauty.exr", 8, 6, {"A", "N.X", "R", "G", "B"});
    GBufferSource source;
    source.beauty_file = folder / "beauty.exr";
    const GBufferReader reader(folder / "data.exr", source);
    const auto planes = read(reader, 1, 3, {"beauty.a", "normal.x", "beauty.r", "channel:R"});
    const auto of = [](const GBufferReader& file, const char* channel) { return read(file, 1, 3, {channel})[0]; };
    EXPECT_EQ(planes[0], of(GBufferReader(folder / "beauty.exr"), "channel:A"));
    EXPECT_EQ(planes[1], of(GBufferReader(folder / "data.exr"), "normal.x"));
    EXPECT_EQ(planes[2], of(GBufferReader(folder / "beauty.exr"), "channel:R"));
    EXPECT_EQ(planes[3], of(GBufferReader(folder / "data.exr"), "channel:R"));
    EXPECT_NE(planes[2], planes[3]);
    EXPECT_FALSE(GBufferReader(folder / "data.exr").has_plane("beauty.a"));
    write_exr(folder / "beauty.exr", 8, 6,
              {"VL.Combined.R", "VL.Combined.G", "VL.Combined.B", "VM.Combined.R", "VM.Combined.G", "VM.Combined.B"});
    expect_mentions(error_of([&] { GBufferReader(folder / "data.exr", source); }),
                    {"\"VL.Combined\", \"VM.Combined\" could be the beauty", "layer = \"VL.Combined\""});
    write_exr(folder / "beauty.exr", 8, 6, {"N.X"});
    expect_mentions(error_of([&] { GBufferReader(folder / "data.exr", source); }), {"beauty.exr", "beauty"});
}

TEST(GBufferReader, SaysWhichRoleHasNoChannels) {
    TempFolder folder;
    write_exr(folder / "a.exr", 4, 4, {"N.X", "N.Y", "N.Z"});
    const GBufferReader reader(folder / "a.exr");
    expect_mentions(error_of([&] {
                        reader.require(Names{"normal.x", "uv.u"});
                    }),
                    {"a.exr", "role \"uv\"", "channels found: N.XYZ", "roles = { uv"});
    expect_mentions(error_of([&] { reader.require(Names{"channel:N.W"}); }), {"no channel \"N.W\"", "nearest: \"N."});
    expect_mentions(error_of([&] {
                        GBufferReader(folder / "a.exr", {.file = {}, .roles = {{"uv", "st"}}});
                    }),
                    {"a.exr: roles: uv = \"st\""});
}

TEST(GBufferReader, RefusesFilesThatAreNoFrames) {
    TempFolder folder;
    expect_mentions(error_of([&] { GBufferReader(folder / "none.exr"); }), {"none.exr: there is no such file"});
    expect_mentions(error_of([&] { GBufferReader(folder / "."); }), {"a folder"});
    write_text(folder / "empty.exr", "");
    expect_mentions(error_of([&] { GBufferReader(folder / "empty.exr"); }), {"empty.exr: the file is empty"});
    write_text(folder / "text.exr", "this is no picture at all, however long it goes on");
    expect_mentions(error_of([&] { GBufferReader(folder / "text.exr"); }), {"text.exr: not an image"});

    auto huge = make_spec(4, 4, {"Z"});
    huge.full_width = 1 << 20;
    write_image(folder / "huge.exr", {{huge}});
    expect_mentions(error_of([&] { GBufferReader(folder / "huge.exr"); }), {"1048576x4", "header is damaged"});

    auto deep = make_spec(4, 4, {"Z"});
    deep.deep = true;
    auto output = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(output->open((folder / "deep.exr").string(), deep));
    OIIO::DeepData data(deep);
    ASSERT_TRUE(output->write_deep_scanlines(0, 4, 0, data));
    ASSERT_TRUE(output->close());
    expect_mentions(error_of([&] { GBufferReader(folder / "deep.exr"); }), {"deep image"});
}

TEST(GBufferReader, NamesTheFirstRowOfATruncatedFile) {
    TempFolder folder;
    // Noise, which ZIP cannot compress: else all rows might lie in what is left of the file.
    write_exr(folder / "cut.exr", 64, 256, {"P.X", "P.Y", "P.Z"}, [](int c, int x, int y) {
        return std::fmod(static_cast<float>((c + 7 * x + 131 * y) * 7919 % 10007), 97.3f);
    });
    std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "cut.exr") / 2);
    const GBufferReader reader(folder / "cut.exr");
    EXPECT_EQ(read(reader, 0, 64, {"position.x"})[0].size(), 64u * 64u);
    const auto text = error_of([&] { read(reader, 0, 256, {"position.x"}); });
    expect_mentions(text, {"cut.exr: row 1", "of 256 cannot be read", "truncated"});
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

// When a file is opened, some rows are read to find out whether normals are packed. That must not be what fails.
TEST(GBufferReader, NamesTheFirstRowOfATruncatedFileOfNormals) {
    TempFolder folder;
    write_exr(folder / "cut.exr", 64, 256, {"N.X", "N.Y", "N.Z"},
              [](int c, int x, int y) { return static_cast<float>((c + 7 * x + 131 * y) * 7919 % 10007) / 10007; });
    std::filesystem::resize_file(folder / "cut.exr", std::filesystem::file_size(folder / "cut.exr") / 4);
    const GBufferReader reader(folder / "cut.exr");
    const auto text = error_of([&] { read(reader, 0, 256, {"normal.x", "normal.y", "normal.z"}); });
    expect_mentions(text, {"cut.exr: row ", "of 256 cannot be read", "truncated"});
    const int row = std::stoi(text.substr(text.find("row ") + 4));
    EXPECT_GE(row, 32) << text;
    EXPECT_LT(row, 80) << text;
}

}  // namespace
}  // namespace wrinkle
