#include "io/nvdb_segments.h"

#include <blosc.h>
#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include "base/claim.h"
#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

constexpr std::uint64_t kMagic = 0x304244566f6e614eull;  // "NanoVDB0"
constexpr std::uint16_t kPlain = 0, kZip = 1, kBlosc = 2;
constexpr std::uint64_t kBloscChunk = std::uint64_t{1} << 30;  // bytes in memory of all chunks but the last
constexpr std::uint32_t kLongestName = 1 << 16;
constexpr double kLz4 = 255;  // the most bytes that LZ4 makes of one

struct SegmentHead {
    std::uint64_t magic;
    std::uint32_t version;
    std::uint16_t grids, codec;
};
static_assert(sizeof(SegmentHead) == 16);

/// Of the 176 bytes that describe a grid, what is needed here.
struct GridHead {
    std::uint64_t bytes, stored, name_hash, active;
    std::uint32_t type, grid_class;
    std::array<std::byte, 96> boxes_and_voxel;
    std::uint32_t name_bytes;
    std::array<std::byte, 36> counts;
};
static_assert(sizeof(GridHead) == 176);

[[noreturn]] void damaged(const InputFile& file, const std::string& what) {
    throw Error(fmt::format("{}: cannot be read: {}; it is truncated or damaged", file.name(), what));
}

void read(const InputFile& file, std::uint64_t at, void* to, std::size_t size) {
    if (file.read_at(at, to, size) != size) damaged(file, "it ends before its grids do");
}

void check(const InputFile& file, const NvdbGrid& grid) {
    if (grid.stored > file.size() || grid.at > file.size() - grid.stored)
        damaged(file, fmt::format("the grid {} lies beyond the file's end", quote(grid.name)));
    const double expansion = grid.codec == kPlain ? 1 : grid.codec == kZip ? kDeflate : kLz4;
    if (grid.codec > kBlosc) damaged(file, fmt::format("compression {} is unknown", grid.codec));
    check_claim(file.name(),
                {fmt::format("a grid {}", quote(grid.name)), static_cast<double>(grid.bytes), grid.stored, expansion});
}

/// The packed bytes at `at`, whose number stands in the 8 bytes before them. Moves `at` behind them.
std::vector<std::byte> packed_at(const InputFile& file, const NvdbGrid& grid, std::uint64_t& at) {
    std::uint64_t size = 0;
    read(file, at, &size, sizeof size);
    at += sizeof size;
    const std::uint64_t end = grid.at + grid.stored;
    if (at > end || size > end - at) damaged(file, fmt::format("the grid {} overlaps its end", quote(grid.name)));
    std::vector<std::byte> packed(size);
    read(file, at, packed.data(), packed.size());
    at += size;
    return packed;
}

}  // namespace

std::vector<NvdbGrid> list_nvdb_grids(const InputFile& file) {
    std::vector<NvdbGrid> grids;
    std::uint64_t at = 0;
    while (at < file.size()) {
        SegmentHead segment;
        read(file, at, &segment, sizeof segment);
        if (segment.magic != kMagic) damaged(file, "a segment does not begin as NanoVDB's do");
        at += sizeof segment;
        const std::size_t first = grids.size();
        for (int i = 0; i < segment.grids; ++i) {
            GridHead head;
            read(file, at, &head, sizeof head);
            at += sizeof head;
            if (head.name_bytes > kLongestName) damaged(file, "the name of a grid is too long");
            NvdbGrid grid{std::string(head.name_bytes, '\0'), head.type, head.bytes, 0, head.stored, segment.codec};
            read(file, at, grid.name.data(), grid.name.size());
            at += grid.name.size();
            grid.name.resize(std::min(grid.name.find('\0'), grid.name.size()));
            grids.push_back(std::move(grid));
        }
        for (NvdbGrid& grid : std::span(grids).subspan(first)) {
            grid.at = at;
            check(file, grid);
            at += grid.stored;
        }
    }
    return grids;
}

void unpack_nvdb_grid(const InputFile& file, const NvdbGrid& grid, std::span<std::byte> to) {
    const auto failed = [&] { damaged(file, fmt::format("the grid {} cannot be unpacked", quote(grid.name))); };
    std::uint64_t at = grid.at;
    if (grid.codec == kPlain) {
        if (to.size() > grid.stored) failed();
        return read(file, at, to.data(), to.size());
    }
    if (grid.codec == kZip) {
        const auto packed = packed_at(file, grid, at);
        const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> zip(
            libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
        if (libdeflate_zlib_decompress(zip.get(), packed.data(), packed.size(), to.data(), to.size(), nullptr) !=
            LIBDEFLATE_SUCCESS)
            failed();
        return;
    }
    while (!to.empty()) {
        const auto chunk = to.first(std::min<std::uint64_t>(to.size(), kBloscChunk));
        const auto packed = packed_at(file, grid, at);
        std::size_t bytes = 0;
        if (blosc_cbuffer_validate(packed.data(), packed.size(), &bytes) != 0 || bytes != chunk.size() ||
            blosc_decompress_ctx(packed.data(), chunk.data(), chunk.size(), 1) != static_cast<int>(chunk.size()))
            failed();
        to = to.subspan(chunk.size());
    }
}

}  // namespace wrinkle::io
