#include "io/zip_blocks.h"

#include <OpenImageIO/imagebuf.h>

#include <bit>
#include <cstring>
#include <random>

#include "io/image_open.h"
#include "tests/io/files.h"

namespace wrinkle::io {
namespace {

using namespace test;

constexpr int width = 33, height = 50, block = 16;
const std::vector<std::string> names{"A", "N.X", "N.Y", "N.Z", "id"};

/// Float channels, of which some are half, and a channel of unsigned integers.
OIIO::ImageSpec mixed_spec(const char* compression) {
    auto spec = make_spec(width, height, names);
    spec.channelformats = {OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeFloat, OIIO::TypeHalf, OIIO::TypeUInt32};
    spec.attribute("compression", compression);
    return spec;
}

/// A number below 1 that differs in every channel and pixel. For unsigned integers it is a share of the largest one.
float shares(int channel, int x, int y) { return numbered(channel, x, y) / 1000; }

/// A channel as OpenImageIO reads it. Unsigned integers are given as their bits.
std::vector<float> library_reads(const std::filesystem::path& file, int part, const std::string& name) {
    const auto input = OIIO::ImageInput::open(file.string());
    const auto spec = input->spec(part);
    const int channel = static_cast<int>(std::ranges::find(spec.channelnames, name) - spec.channelnames.begin());
    const bool whole = spec.channelformat(channel) == OIIO::TypeUInt32;
    std::vector<float> values(std::size_t{width} * static_cast<std::size_t>(spec.height));
    EXPECT_TRUE(input->read_scanlines(part, 0, spec.y, spec.y + spec.height, 0, channel, channel + 1,
                                      whole ? OIIO::TypeUInt32 : OIIO::TypeFloat, values.data()));
    return values;
}

/// The blocks of a file, beside what OpenImageIO says of it.
struct Opened {
    explicit Opened(const std::filesystem::path& file)
        : image(file), listed(list_parts(image.input(), file)), blocks(image.file(), listed.parts) {}

    BlockChannel channel(int part, std::string_view name, std::span<float> out) const {
        for (const auto& place : listed.channels)
            if (place.part == part && place.stored_name == name) return {name, out, place.whole_numbers, place.half};
        return {name, out};
    }

    OpenImage image;
    ImageParts listed;
    ZipBlocks blocks;
};

/// Reads some channels interleaved, and expects the same bits as OpenImageIO's.
void expect_same(const std::filesystem::path& file, int part, const std::vector<int>& channels, int begin, int end) {
    Opened opened(file);
    // One more than there are channels: the last number of each pixel must stay as it is.
    const std::size_t stride = channels.size() + 1;
    std::vector<float> read(stride * width * static_cast<std::size_t>(end - begin), -7.0F);
    std::vector<BlockChannel> wanted;
    for (std::size_t i = 0; i < channels.size(); ++i)
        wanted.push_back(
            opened.channel(part, names[static_cast<std::size_t>(channels[i])], std::span(read).subspan(i)));
    ASSERT_TRUE(opened.blocks.read(part, wanted, begin, end, stride)) << file;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const auto expected = library_reads(file, part, names[static_cast<std::size_t>(channels[i])]);
        for (std::size_t p = 0; p < read.size() / stride; ++p) {
            ASSERT_EQ(std::bit_cast<std::uint32_t>(read[p * stride + i]),
                      std::bit_cast<std::uint32_t>(expected[p + static_cast<std::size_t>(begin) * width]))
                << file << ", channel " << channels[i] << ", pixel " << p;
            ASSERT_EQ(read[p * stride + stride - 1], -7.0F);
        }
    }
}

TEST(ZipBlocks, GiveTheBitsThatOpenImageIoGives) {
    TempFolder folder;
    std::mt19937 random(5);
    const auto noise = [&](int, int, int) {  // cannot be compressed, so its blocks are stored as they are
        return std::bit_cast<float>(static_cast<std::uint32_t>(random()) % 0x7f000000U);
    };
    auto plain = make_spec(width, height, names);
    const struct {
        const char* name;
        OIIO::ImageSpec spec;
        Pixel pixel;
    } files[] = {{"zip.exr", mixed_spec("zip"), shares},
                 {"zips.exr", mixed_spec("zips"), shares},
                 {"noise.exr", plain, noise},
                 {"one_value.exr", mixed_spec("zip"), [](int, int, int) { return 0.25F; }}};
    for (const auto& file : files) {
        write_image(folder / file.name, {{file.spec, file.pixel}});
        expect_same(folder / file.name, 0, {0, 1, 2, 3, 4}, 0, height);
        expect_same(folder / file.name, 0, {3, 1}, block, height);
        expect_same(folder / file.name, 0, {4}, block, 2 * block);
        expect_same(folder / file.name, 0, {2}, 3 * block, height);
    }
}

TEST(ZipBlocks, OfEachPartAndFromTheDataWindowsTop) {
    TempFolder folder;
    auto first = mixed_spec("zip"), second = mixed_spec("zip");
    first.y = second.y = -7, first.x = second.x = 3;
    first.attribute("oiio:subimagename", "a"), second.attribute("oiio:subimagename", "b");
    write_image(folder / "parts.exr",
                {{first, shares}, {second, [](int c, int x, int y) { return shares(c, y, x) / 3; }}});
    expect_same(folder / "parts.exr", 0, {1, 4}, 0, height);
    expect_same(folder / "parts.exr", 1, {1, 4}, block, height);
}

/// Whether ZipBlocks reads these rows, or leaves them to OpenImageIO.
bool reads(const std::filesystem::path& file, int begin, int end, std::string_view channel = "N.X", int part = 0) {
    std::vector<float> rows(std::size_t{width} * height);
    Opened opened(file);
    const BlockChannel wanted[] = {opened.channel(part, channel, rows)};
    return opened.blocks.read(part, wanted, begin, end, 1);
}

TEST(ZipBlocks, LeaveToOthersWhatTheyDoNotKnow) {
    TempFolder folder;
    auto tiles = make_spec(width, height, names), other = tiles;
    tiles.tile_width = tiles.tile_height = 16;
    other.attribute("compression", "piz");
    write_image(folder / "tiles.exr", {{tiles}});
    write_image(folder / "piz.exr", {{other}});
    write_exr(folder / "zip.exr", width, height, names);
    EXPECT_TRUE(reads(folder / "zip.exr", 0, height));
    EXPECT_FALSE(reads(folder / "zip.exr", 3, height)) << "not a block's first row";
    EXPECT_FALSE(reads(folder / "zip.exr", 0, 20)) << "not a block's end";
    EXPECT_FALSE(reads(folder / "zip.exr", 0, height, "N")) << "no such channel";
    EXPECT_FALSE(reads(folder / "zip.exr", 0, height, "N.X", 1)) << "no such part";
    for (const char* name : {"tiles.exr", "piz.exr"}) EXPECT_FALSE(reads(folder / name, 0, height)) << name;
}

/// OpenEXRCore parses the file again. What it finds is no measure of memory that another parser's answer was taken for.
TEST(ZipBlocks, LeaveToOthersWhatIsNotAsOpenImageIoSays) {
    TempFolder folder;
    write_exr(folder / "zip.exr", width, height, names);
    std::vector<float> rows(std::size_t{width} * height);
    const OpenImage image(folder / "zip.exr");
    const auto listed = list_parts(image.input(), folder / "zip.exr");
    const auto reads_as = [&](const Part& part, BlockChannel channel) {
        return ZipBlocks(image.file(), {&part, 1}).read(0, {&channel, 1}, 0, height, 1);
    };
    const Part right = listed.parts[0];
    const BlockChannel channel{"N.X", rows};
    EXPECT_TRUE(reads_as(right, channel));
    for (int Part::*side : {&Part::width, &Part::height, &Part::origin_x, &Part::origin_y, &Part::tile_height})
        for (const int step : {-1, 1}) {
            Part wrong = right;
            wrong.*side += step;
            EXPECT_FALSE(reads_as(wrong, channel)) << wrong.*side;
        }
    EXPECT_FALSE(reads_as(right, {"N.X", rows, true})) << "whole numbers";
    EXPECT_FALSE(reads_as(right, {"N.X", rows, false, true})) << "half";
    EXPECT_FALSE(reads_as(right, {"N.X", std::span(rows).first(rows.size() - 1)})) << "a destination too small";
    const Part two[] = {right, right};
    EXPECT_FALSE(ZipBlocks(image.file(), two).read(0, {&channel, 1}, 0, height, 1)) << "another number of parts";
}

TEST(ZipBlocks, NoticeDamage) {
    TempFolder folder;
    const auto file = folder / "zip.exr", damaged = folder / "damaged.exr";
    write_exr(file, width, height, names);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    for (const std::size_t cut : {bytes.size() - 1, bytes.size() / 2}) {
        std::ofstream(damaged, std::ios::binary) << bytes.substr(0, cut);
        EXPECT_FALSE(reads(damaged, 0, height)) << cut << " of " << bytes.size() << " bytes";
    }
    std::mt19937 random(9);
    int noticed = 0;
    // Behind the last attribute of the header, and the table of where blocks are.
    const auto blocks = bytes.find("screenWindowWidth") + 64;
    // Damage may go unnoticed where no checksum covers it, but must not crash.
    for (int trial = 0; trial < 400; ++trial) {
        std::string changed = bytes;
        changed[blocks + random() % (bytes.size() - blocks)] ^= static_cast<char>(1 + random() % 255);
        std::ofstream(damaged, std::ios::binary) << changed;
        noticed += reads(damaged, 0, height) ? 0 : 1;
    }
    EXPECT_GT(noticed, 380);
    std::string changed = bytes;
    changed[bytes.size() - 20] ^= 0x55;  // in the last block
    std::ofstream(damaged, std::ios::binary) << changed;
    EXPECT_TRUE(reads(damaged, 0, 3 * block));
    EXPECT_FALSE(reads(damaged, 3 * block, height));
}

}  // namespace
}  // namespace wrinkle::io
