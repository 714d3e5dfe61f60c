#include "io/nvdb_segments.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>

#include "io/volume_file.h"
#include "tests/io/files.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr std::size_t kSegmentHead = 16, kGridHead = 176, kCodecAt = 14, kStoredAt = kSegmentHead + 8;
constexpr std::size_t kNameBytesAt = kSegmentHead + 136;

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// A NanoVDB file of a few leaves and tiles, whose grid lies in it uncompressed, and without a checksum. `grid` is
/// where it begins.
std::string plain_file(const TempFolder& folder, std::size_t& grid) {
    DenseVolume volume;
    volume.first = {-5, 3, -20}, volume.size = {40, 20, 20};
    for (int i = 0; i < 40 * 20 * 20; ++i)
        volume.values.push_back(i % 40 < 16 ? 0.5F : std::sin(0.37F * static_cast<float>(i)));
    volume.world_from_index = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    save_volume(folder / "zip.nvdb", volume);
    std::ifstream in(folder / "zip.nvdb", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    grid = kSegmentHead + kGridHead + number_at<std::uint32_t>(bytes, kNameBytesAt);
    auto size = static_cast<uLongf>(number_at<std::uint64_t>(bytes, kSegmentHead));
    std::string unpacked(size, '\0');
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes.data() + grid + 8), bytes.size() - grid - 8),
              Z_OK);
    bytes.resize(grid);
    put(bytes, kCodecAt, std::uint16_t{0});
    put(bytes, kStoredAt, std::uint64_t{size});
    bytes += unpacked;
    put(bytes, grid + 8, ~std::uint64_t{0});
    return bytes;
}

/// What loading throws; empty when the volume could be loaded.
std::string outcome(const fs::path& file, const std::string& bytes) {
    write_text(file, bytes);
    try {
        load_volume(file, "");
    } catch (const Error& error) { return error.what(); }
    return {};
}

TEST(NvdbSegments, AnUncompressedGridIsRead) {
    const TempFolder folder;
    std::size_t grid = 0;
    const std::string bytes = plain_file(folder, grid);
    EXPECT_EQ(outcome(folder / "plain.nvdb", bytes), "");
    const Volume plain = load_volume(folder / "plain.nvdb", ""), zip = load_volume(folder / "zip.nvdb", "");
    EXPECT_EQ(plain.voxels, zip.voxels);
    EXPECT_EQ(plain.blocks, zip.blocks);
}

/// Every number of the headers, of the tree and of the first nodes, set to what would lead elsewhere.
TEST(NvdbSegments, NoNumberLeadsOutOfTheFile) {
    const TempFolder folder;
    std::size_t grid = 0;
    const std::string bytes = plain_file(folder, grid);
    constexpr std::size_t kGridTreeAndRoot = 672 + 64 + 256;
    int refused = 0;
    constexpr std::size_t kNameAndMap = 40, kBehindMap = 560;  // of the grid's header; these lead nowhere
    for (std::size_t at = 0; at < grid + kGridTreeAndRoot;
         at += at == grid / 8 * 8 + kNameAndMap ? kBehindMap - kNameAndMap : 8)
        for (const std::uint64_t value :
             {std::uint64_t{0xffffffff}, std::uint64_t{1} << 20, std::uint64_t{1} << 40, ~std::uint64_t{0} - 31}) {
            std::string changed = bytes;
            if (value > 0xffffffff && at % 8 == 0)
                put(changed, at, value);
            else
                put(changed, at, static_cast<std::uint32_t>(value));
            refused += outcome(folder / "a.nvdb", changed).empty() ? 0 : 1;
        }
    EXPECT_GT(refused, 60);
    std::mt19937 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        std::string changed = bytes;
        for (int k = 0; k < 4; ++k) changed[random() % changed.size()] = static_cast<char>(random());
        outcome(folder / "a.nvdb", changed);
    }
}

TEST(NvdbSegments, SaysWhatIsWrong) {
    const TempFolder folder;
    std::size_t grid = 0;
    const std::string bytes = plain_file(folder, grid);
    constexpr std::size_t kTree = 672;
    const auto with = [&](std::size_t at, auto value) {
        std::string changed = bytes;
        put(changed, at, value);
        return outcome(folder / "a.nvdb", changed);
    };
    expect_mentions(with(kStoredAt, std::uint64_t{1} << 40), {"a.nvdb", "lies beyond the file's end"});
    expect_mentions(with(kSegmentHead, std::uint64_t{1} << 36), {"a.nvdb: it claims a grid \"density\"", "68.7 GB"});
    expect_mentions(with(kNameBytesAt, std::uint32_t{1} << 30), {"a.nvdb", "name of a grid"});
    expect_mentions(with(kCodecAt, std::uint16_t{7}), {"a.nvdb", "compression 7 is unknown"});
    expect_mentions(with(grid + kTree, std::uint64_t{1} << 30), {"a.nvdb", "its leaves does not fit"});
    expect_mentions(with(grid + kTree + 32, std::uint32_t{1} << 30), {"a.nvdb", "its leaves does not fit"});
    expect_mentions(with(grid + kTree + 24, ~std::uint64_t{0} - 31), {"a.nvdb", "its root does not fit"});
    expect_mentions(with(grid + 8, std::uint64_t{1}), {"a.nvdb", "a checksum does not fit"});
}

}  // namespace
}  // namespace wrinkle
