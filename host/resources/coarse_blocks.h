#pragma once

#include <OpenImageIO/parallel.h>

#include <array>
#include <cstdint>
#include <optional>

#include "io/volume.h"

/// Coarser grids, a block at a time: what means of values and means of products share.
namespace wrinkle {

/// The next coarser level's grid, without any blocks yet: its box covers that of `fine` grown by `more` voxels on each
/// side.
Volume coarse_box(const Volume& fine, int channels, int more);

/// The number of the constant that all blocks of `fine` have which touch voxels [first, end) of each axis, counted from
/// a block's first voxel; nothing if there is another block among them.
std::optional<std::int32_t> common_constant(const Volume& fine, const std::array<int, 3>& block, int first, int end);

/// Numbers the blocks marked by a 0 and makes room for their voxels, and for those of `grids` such grids in all.
void number_blocks(Volume& coarse, double grids = 1);

/// Where channel `c` of a stored block begins.
float* channel_of(Volume& volume, std::size_t place, int c);

/// Calls work(place in Volume::blocks, the first of the 2 x 2 x 2 finer blocks) for every block, several at once.
template <class Work>
void for_each_block(const Volume& coarse, const Work& work) {
    const int wide = coarse.count[0], high = coarse.count[1], deep = coarse.count[2];
    OIIO::parallel_for(std::int64_t{0}, std::int64_t{wide} * high * deep, [&](std::int64_t i) {
        const std::array<int, 3> at{static_cast<int>(i % wide), static_cast<int>(i / wide % high),
                                    static_cast<int>(i / wide / high)};
        std::array<int, 3> fine{};
        for (std::size_t axis = 0; axis < 3; ++axis) fine[axis] = 2 * (coarse.first[axis] + at[axis]);
        work(static_cast<std::size_t>(i), fine);
    });
}

/// The next coarser level: means of 2 x 2 x 2 voxels.
Volume half_of(const Volume& fine);

}  // namespace wrinkle
