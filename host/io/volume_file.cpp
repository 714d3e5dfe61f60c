#include "io/volume_file.h"

#include <fmt/format.h>
#include <unistd.h>
#include <ext/stdio_filebuf.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "base/atomic_file.h"
#include "base/claim.h"
#include "base/input_file.h"
#include "base/limits.h"
#include "base/names.h"
#include "io/reason.h"
#include "io/volume_child.h"
#include "io/volume_grid.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

namespace fs = std::filesystem;
using io::ListedGrid, io::RawVolume;

constexpr std::uint64_t kVdbMagic = 0x56444220, kNvdbMagic = 0x304244566f6e614eull;  // " BDV", "NanoVDB0"
constexpr double kMostBlocks = 1 << 28;                                              // their index then takes 1 GiB
constexpr double kMostAlongAnAxis = (1 << 24) / 8;  // kernels count voxels from the first in float
constexpr int kFarthest = (1 << 27) - 1;            // block from the origin: voxels stay within int, with ring
/// Bytes of index that any file may ask for, and that a byte of a larger one may, at most. A leaf takes kilobytes of
/// the file and one entry of the index, but two that lie far from each other, or one tile, span any number of entries.
constexpr double kSmallIndex = 256 << 20, kIndexExpansion = 20;

std::string list(const std::vector<ListedGrid>& grids) {
    std::string text;
    for (const ListedGrid& grid : grids)
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", quote(grid.name), grid.type);
    return text.empty() ? "none" : text;
}

/// The number of the grid named `wanted`. When that is empty, of the only grid that can be used.
std::size_t choose(const fs::path& file, const std::vector<ListedGrid>& grids, const std::string& wanted) {
    std::vector<std::size_t> fitting;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        names.push_back(grids[i].name);
        if (wanted.empty() ? grids[i].usable : grids[i].name == wanted) fitting.push_back(i);
    }
    if (!wanted.empty() && fitting.empty())
        throw Error(fmt::format("{}: there is no grid {}{}; grids: {}", file.string(), quote(wanted),
                                did_you_mean(wanted, names), list(grids)));
    if (fitting.empty())
        throw Error(fmt::format("{}: holds no grid of float, double or 3-vectors of them; grids: {}", file.string(),
                                list(grids)));
    if (wanted.empty() && fitting.size() > 1)
        throw Error(
            fmt::format("{}: holds several grids, name one with the key \"grid\": {}", file.string(), list(grids)));
    const ListedGrid& grid = grids[fitting.front()];
    if (!grid.usable)
        throw Error(fmt::format("{}: the grid {} holds {}; float, double or 3-vectors of them are expected; grids: {}",
                                file.string(), quote(grid.name), grid.type, list(grids)));
    return fitting.front();
}

/// True for NanoVDB, false for OpenVDB. Throws Error when the file is neither, or of a version that cannot be read.
bool is_nano(const InputFile& file) {
    struct {
        std::uint64_t magic = 0;
        std::uint32_t version = 0, rest = 0;
    } head;
    const bool whole = file.read_at(0, &head, sizeof head) == sizeof head;
    const bool nano = head.magic == kNvdbMagic;
    if (!whole || (!nano && head.magic != kVdbMagic))
        throw Error(fmt::format("{}: is neither an OpenVDB (.vdb) nor a NanoVDB (.nvdb) file", file.name()));
    if (!nano && head.version > io::newest_vdb())
        throw Error(
            fmt::format("{}: has OpenVDB file version {}; versions up to {} can be read: save it with an older "
                        "OpenVDB",
                        file.name(), head.version, io::newest_vdb()));
    if (nano && head.version >> 21 != io::nvdb_version())
        throw Error(fmt::format("{}: has NanoVDB version {}; version {} can be read: convert it, or save a .vdb",
                                file.name(), head.version >> 21, io::nvdb_version()));
    return nano;
}

/// What a library's message says to a user, as reason() gives it: "IoError: no space" becomes "no space". A message of
/// a single word becomes empty, as it is a name from inside the library.
std::string readable(const std::string& text) {
    const std::size_t colon = text.find(": ");
    const bool named = colon != std::string::npos && text.find(' ') > colon;
    const std::string why = io::reason(named ? text.substr(colon + 2) : text);
    return why.find(' ', 1) == std::string::npos ? "" : why;
}

/// Runs `work`. What the libraries throw becomes an Error: `what` is its format, of the file's name and the reason.
template <class Work>
auto told(const fs::path& file, const char* what, const Work& work) {
    try {
        return work();
    } catch (const Error&) { throw; } catch (const std::bad_alloc&) {
        throw Error(fmt::format(fmt::runtime(what), file.string(), " (out of memory)"));
    } catch (const std::exception& error) {
        throw Error(fmt::format(fmt::runtime(what), file.string(), readable(error.what())));
    }
}

/// OpenVDB files by another process, where that is wanted.
std::pair<RawVolume, std::string> read_wherever(const InputFile& file, const std::string& wanted, bool voxels) {
    const bool elsewhere = !limits().volume_reader.empty() && !is_nano(file);
    return elsewhere ? io::read_grid_in_child(file, wanted, voxels) : io::read_grid(file, wanted, voxels);
}

VolumeInfo info_of(const fs::path& file, const std::string& name, const RawVolume& raw) {
    const auto fail = [&](const std::string& text) {
        return Error(fmt::format("{}: the transform of the grid {} {}", file.string(), quote(name), text));
    };
    if (!raw.affine) throw fail("is a frustum; an affine one is expected");
    if (is_singular(raw.world_from_index)) throw fail("cannot be inverted: its axes are zero, parallel or not finite");
    return {name, raw.channels, inverse(raw.world_from_index)};
}

bool finite(const std::array<float, 3>& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

struct BlockBox {
    std::array<int, 3> low, high;
    double blocks = 1;  ///< in it
};

/// The box of blocks around leaves and tiles. Throws what `fail` makes of the reason when no device could index it.
template <class Fail>
BlockBox box_of(const InputFile& file, const RawVolume& raw, const Fail& fail) {
    BlockBox box;
    box.low.fill(std::numeric_limits<int>::max()), box.high.fill(std::numeric_limits<int>::min());
    const auto expand = [&](const std::array<int, 3>& at) {
        for (std::size_t k = 0; k < 3; ++k)
            box.low[k] = std::min(box.low[k], at[k]), box.high[k] = std::max(box.high[k], at[k]);
    };
    for (const auto& leaf : raw.leaves) expand(leaf);
    for (const RawVolume::Tile& tile : raw.tiles) expand(tile.first), expand(tile.last);
    double with_ring = 1;
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) {
        box.blocks *= extent[k] = 1.0 + box.high[k] - box.low[k];
        with_ring *= extent[k] + 2 * Volume::ring;
    }
    const auto size = [&] {
        return fmt::format("spans {:.0f} x {:.0f} x {:.0f} voxels", Volume::edge * extent[0], Volume::edge * extent[1],
                           Volume::edge * extent[2]);
    };
    if (with_ring > kMostBlocks || std::ranges::max(extent) + 2 * Volume::ring > kMostAlongAnAxis)
        throw fail(
            fmt::format("{}, {:.3g} blocks of 8 x 8 x 8; {:.3g} fit, and {:.0f} along an axis: crop or resample it",
                        size(), with_ring, kMostBlocks, kMostAlongAnAxis));
    for (std::size_t k = 0; k < 3; ++k)
        if (box.low[k] < -kFarthest || box.high[k] > kFarthest)
            throw fail(
                fmt::format("reaches from voxel {} to {} along axis {}; indices go up to {}: move it to the origin",
                            8.0 * box.low[k], 8.0 * box.high[k] + 7, k, 8LL * kFarthest));
    const double index = with_ring * sizeof(std::int32_t);
    if (index > std::max(kSmallIndex, kIndexExpansion * static_cast<double>(file.size())))
        throw fail(
            fmt::format("{}, of which only an index takes {} in memory, for a file of {}: crop or resample it, unless "
                        "it is damaged",
                        size(), bytes_text(index), bytes_text(static_cast<double>(file.size()))));
    check_memory(file.name(), index, "the index of a grid that " + size());
    return box;
}

/// Sorts leaves and tiles into the box of blocks. Throws Error when the grid is empty, too large or not finite.
Volume assemble(const InputFile& file, RawVolume raw, VolumeInfo info) {
    const auto fail = [&](const std::string& text) {
        return Error(fmt::format("{}: the grid {} {}", file.name(), quote(info.grid), text));
    };
    if (raw.leaves.empty() && raw.tiles.empty()) throw fail("is empty: it holds its background and nothing else");
    if (!finite(raw.background)) throw fail("has a background that is not finite");
    const auto [low, high, blocks] = box_of(file, raw, fail);
    double filled = static_cast<double>(raw.leaves.size());
    for (const RawVolume::Tile& tile : raw.tiles) {
        double size = 1;
        for (std::size_t k = 0; k < 3; ++k) size *= 1.0 + tile.last[k] - tile.first[k];
        filled += size;
    }
    if (filled > blocks) throw fail("holds regions that overlap; the file is damaged");

    Volume out;
    out.info = info;
    out.first = low;
    for (std::size_t k = 0; k < 3; ++k) out.count[k] = high[k] - low[k] + 1;
    out.blocks.assign(static_cast<std::size_t>(blocks), -1);
    std::ranges::copy(raw.background, out.constants.begin());
    for (const RawVolume::Tile& tile : raw.tiles) {
        if (!finite(tile.value)) throw fail("has a constant region that is not finite");
        const auto number = -1 - static_cast<std::int32_t>(out.constants.size() / 3);
        out.constants.insert(out.constants.end(), tile.value.begin(), tile.value.end());
        for (int z = tile.first[2]; z <= tile.last[2]; ++z)
            for (int y = tile.first[1]; y <= tile.last[1]; ++y)
                for (int x = tile.first[0]; x <= tile.last[0]; ++x) out.blocks[*out.block(x, y, z)] = number;
    }
    std::int32_t count = 0;
    for (const auto& leaf : raw.leaves) out.blocks[*out.block(leaf[0], leaf[1], leaf[2])] = count++;
    out.voxels = std::move(raw.voxels);
    const auto is_bad = [](float v) { return !std::isfinite(v); };
    if (const auto bad = std::ranges::find_if(out.voxels, is_bad); bad != out.voxels.end()) {
        const auto place = static_cast<std::size_t>(bad - out.voxels.begin());
        const auto& leaf = raw.leaves[place / (Volume::block_voxels * static_cast<std::size_t>(out.info.channels))];
        const auto i = static_cast<int>(place % Volume::block_voxels);
        throw fail(fmt::format("has {} numbers that are NaN or beyond float; the first is at index ({}, {}, {})",
                               std::ranges::count_if(out.voxels, is_bad), 8 * leaf[0] + i % 8, 8 * leaf[1] + i / 8 % 8,
                               8 * leaf[2] + i / 64));
    }
    return out;
}

}  // namespace

std::pair<RawVolume, std::string> io::read_grid(const InputFile& file, const std::string& wanted, bool voxels) {
    const bool nano = is_nano(file);
    return told(file.path(), "{}: cannot be read{}; it may be truncated or damaged", [&] {
        const std::vector<ListedGrid> grids = nano ? io::list_nvdb(file) : io::list_vdb(file);
        const std::size_t chosen = choose(file.path(), grids, wanted);
        return std::pair(nano ? io::read_nvdb(file, chosen) : io::read_vdb(file, grids[chosen].name, voxels),
                         grids[chosen].name);
    });
}

Volume load_volume(const fs::path& file, const std::string& grid) {
    const InputFile opened(file, "a volume file");
    return told(file, "{}: cannot be used{}", [&] {
        auto [raw, name] = read_wherever(opened, grid, true);
        VolumeInfo info = info_of(file, name, raw);
        return assemble(opened, std::move(raw), std::move(info));
    });
}

VolumeInfo volume_info(const fs::path& file, const std::string& grid) {
    const auto [raw, name] = read_wherever(InputFile(file, "a volume file"), grid, false);
    return info_of(file, name, raw);
}

void check_volume_name(const fs::path& file, int channels) {
    const std::string extension = lower(file.extension().string());
    if (extension != ".vdb" && extension != ".nvdb")
        throw Error(fmt::format("cannot write {}: \"{}\" is no extension of a volume file; use .vdb or .nvdb",
                                file.string(), file.extension().string()));
    if (extension == ".nvdb" && channels != 1)
        throw Error(fmt::format("cannot write {}: vectors can be written as .vdb only", file.string()));
}

void save_volume(const fs::path& file, const DenseVolume& volume) {
    check_volume_name(file, volume.channels);
    const bool nano = lower(file.extension().string()) == ".nvdb";
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    AtomicFile complete(file);
    __gnu_cxx::stdio_filebuf<char> buffer(::dup(complete.descriptor()), std::ios::out | std::ios::binary, kBlock);
    std::ostream out(&buffer);
    out.exceptions(std::ios::failbit | std::ios::badbit);
    told(file, "cannot write {}{}", [&] {
        try {
            nano ? io::write_nvdb(out, volume) : io::write_vdb(out, volume);
            out.flush();
        } catch (const std::ios::failure&) { throw Error(complete.failure(std::strerror(errno))); }
    });
    complete.commit();
}

}  // namespace wrinkle
