#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// Whether an affine matrix cannot be inverted, as an axis is zero or not finite, or axes are nearly parallel.
bool is_singular(const Mat4& m);

/// What is known of a grid without reading its voxels.
struct VolumeInfo {
    std::string grid;
    int channels = 1;         ///< 1: float values; 3: vectors
    Mat4 index_from_world{};  ///< affine; centres of voxels lie at whole indices
};

/// A sparse grid: a box of blocks of 8 x 8 x 8 voxels each. A block has its own voxels or is constant. Outside of the
/// box everything is background.
struct Volume {
    static constexpr int edge = 8;
    static constexpr std::size_t block_voxels = edge * edge * edge;
    /// Blocks of background that devices store around the box: the first on each side holds voxels of the grid at its
    /// border, the second is background alone.
    static constexpr int ring = 2;

    VolumeInfo info;
    std::array<int, 3> first{}, count{};  ///< the box: its first block, and how many along each axis
    std::vector<std::int32_t> blocks;     ///< of the box, x fastest: place in `voxels`, or -1 - place in `constants`
    std::vector<float> voxels;  ///< for each block and channel 512 numbers, x fastest; a block's channels one by one
    std::vector<float> constants{0, 0, 0};  ///< 3 numbers each; the first constant is the background

    /// The place of a block in `blocks`. Nothing outside of the box.
    std::optional<std::size_t> block(int x, int y, int z) const;
    /// The value of any voxel, also outside of the box.
    float at(int x, int y, int z, int channel) const;
};

}  // namespace wrinkle
