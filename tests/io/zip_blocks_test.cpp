#include "io/zip_blocks.h"

#include <OpenImageIO/imagebuf.h>

#include <bit>
#include <cstring>
#include <random>

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

/// Reads some channels interleaved, and expects the same bits as OpenImageIO's.
void expect_same(const std::filesystem::path& file, int part, const std::vector<int>& channels, int begin, int end) {
    ZipBlocks blocks(file);
    // One more than there are channels: the last number of each pixel must stay as it is.
    const std::size_t stride = channels.size() + 1;
    std::vector<float> read(stride * width * static_cast<std::size_t>(end - begin), -7.0F);
    std::vector<BlockChannel> wanted;
    for (std::size_t i = 0; i < channels.size(); ++i)
        wanted.push_back({names[static_cast<std::size_t>(channels[i])], read.data() + i});
    ASSERT_TRUE(blocks.read(part, wanted, begin, end, stride)) << file;
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
    const BlockChannel wanted[] = {{channel, rows.data()}};
    return ZipBlocks(file).read(part, wanted, begin, end, 1);
}

TEST(ZipBlocks, LeaveToOthersWhatTheyDoNotKnow) {
    TempFolder folder;
    auto tiles = make_spec(width, height, names), other = tiles;
    tiles.tile_width = tiles.tile_height = 16;
    other.attribute("compression", "piz");
    write_image(folder / "tiles.exr", {{tiles}});
    write_image(folder / "piz.exr", {{other}});
    write_exr(folder / "zip.exr", width, height, names);
    write_text(folder / "text.exr", "not an image");
    EXPECT_TRUE(reads(folder / "zip.exr", 0, height));
    EXPECT_FALSE(reads(folder / "zip.exr", 3, height)) << "not a block's first row";
    EXPECT_FALSE(reads(folder / "zip.exr", 0, 20)) << "not a block's end";
    EXPECT_FALSE(reads(folder / "zip.exr", 0, height, "N")) << "no such channel";
    EXPECT_FALSE(reads(folder / "zip.exr", 0, height, "N.X", 1)) << "no such part";
    for (const char* name : {"tiles.exr", "piz.exr", "text.exr", "missing.exr"})
        EXPECT_FALSE(reads(folder / name, 0, height)) << name;
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
