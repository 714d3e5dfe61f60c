#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// Whether an affine matrix cannot be inverted: its axes are zero, nearly parallel, or not finite.
bool is_singular(const Mat4& m);

/// What a grid of a volume file is, without its voxels.
struct VolumeInfo {
    std::string grid;
    int channels = 1;         ///< 1: float values; 3: vectors
    Mat4 index_from_world{};  ///< affine; voxel centres at whole indices
};

/// A sparse grid as blocks of 8 x 8 x 8 voxels: those of a box of blocks; all outside is background.
struct Volume {
    static constexpr int edge = 8;
    static constexpr std::size_t block_voxels = edge * edge * edge;

    VolumeInfo info;
    std::array<int, 3> first{}, count{};  ///< the box, in blocks
    std::vector<std::int32_t> blocks;     ///< of the box, x fastest: number in `voxels`, or -1 - number in `constants`
    std::vector<float> voxels;            ///< 512 a block and channel, x fastest, channel by channel
    std::vector<float> constants{0, 0, 0};  ///< 3 numbers each; the first is the background

    /// Place in `blocks` of a block; nothing outside the box.
    std::optional<std::size_t> block(int x, int y, int z) const;
    /// The voxel of any index.
    float at(int x, int y, int z, int channel) const;
};

}  // namespace wrinkle
