#pragma once

#include <iosfwd>
#include <utility>

#include "base/input_file.h"
#include "io/volume_file.h"

/// What volume_file.cpp shares with the readers and writers of the two volume formats.
namespace wrinkle::io {

/// A grid of a file, as messages tell of it.
struct ListedGrid {
    std::string name, type;
    bool usable = false;  ///< float, double or 3-vectors of them
};

/// A grid as files hold it: leaves with 8^3 voxels each, and tiles, which are boxes of a single value.
struct RawVolume {
    int channels = 1;
    bool affine = true;
    Mat4 world_from_index{};
    std::array<float, 3> background{};
    struct Tile {
        std::array<int, 3> first, last;  ///< its first and last block along each axis
        std::array<float, 3> value;
    };
    std::vector<Tile> tiles;                 ///< without those of the background's value
    std::vector<std::array<int, 3>> leaves;  ///< the block that each leaf fills
    std::vector<float> voxels;               ///< of the leaves, in the order of Volume::voxels
};

/// Appends a leaf. In files z runs fastest, in `raw` x does.
template <class Leaf>
void add_leaf(RawVolume& raw, const Leaf& leaf) {
    const auto numbers = [](const auto& v, float* to) {
        if constexpr (std::is_floating_point_v<std::decay_t<decltype(v)>>)
            *to = static_cast<float>(v);
        else
            for (int c = 0; c < 3; ++c) to[c] = static_cast<float>(v[c]);
    };
    const auto origin = leaf.origin();
    raw.leaves.push_back({origin[0] >> 3, origin[1] >> 3, origin[2] >> 3});
    const auto channels = static_cast<std::size_t>(raw.channels);
    const std::size_t start = raw.voxels.size();
    raw.voxels.resize(start + Volume::block_voxels * channels);
    for (std::uint32_t i = 0; i < Volume::block_voxels; ++i) {
        float value[3] = {};
        numbers(leaf.getValue(i), value);
        const std::uint32_t x = i >> 6, y = i >> 3 & 7, z = i & 7;
        for (std::size_t c = 0; c < channels; ++c)
            raw.voxels[start + c * Volume::block_voxels + (z * 8 + y) * 8 + x] = value[c];
    }
}

/// Reads the grid `wanted`, or the only one, of a file of either format, in this process. Gives the grid and its name.
/// Throws Error.
std::pair<RawVolume, std::string> read_grid(const InputFile& file, const std::string& wanted, bool voxels);

std::vector<ListedGrid> list_vdb(const InputFile& file);
/// With `voxels` false, only the transform and the type are read.
RawVolume read_vdb(const InputFile& file, const std::string& grid, bool voxels);
/// `out` must throw when it cannot be written to.
void write_vdb(std::ostream& out, const DenseVolume& volume);
/// The newest version of OpenVDB files that can be read.
std::uint32_t newest_vdb();

std::vector<ListedGrid> list_nvdb(const InputFile& file);
RawVolume read_nvdb(const InputFile& file, std::size_t number);
/// As write_vdb, but vectors cannot be written.
void write_nvdb(std::ostream& out, const DenseVolume& volume);
/// The major version of NanoVDB files that can be read.
std::uint32_t nvdb_version();

}  // namespace wrinkle::io
