#include "resources/coarse_blocks.h"

#include "base/limits.h"
#include "base/names.h"

namespace wrinkle {

namespace {

constexpr int kEdge = Volume::edge;

}  // namespace

Volume coarse_box(const Volume& fine, int channels, int more) {
    Volume coarse;
    coarse.info = fine.info;
    coarse.info.channels = channels;
    std::size_t blocks = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int first = kEdge * fine.first[axis] - more, end = kEdge * (fine.first[axis] + fine.count[axis]) + more;
        coarse.first[axis] = first >> 4;
        coarse.count[axis] = fine.count[axis] > 0 ? ((end - 1) >> 4) + 1 - coarse.first[axis] : 0;
        blocks *= static_cast<std::size_t>(coarse.count[axis]);
    }
    coarse.blocks.assign(blocks, -1);
    return coarse;
}

std::optional<std::int32_t> common_constant(const Volume& fine, const std::array<int, 3>& block, int first, int end) {
    std::optional<std::int32_t> common;
    for (int z = first >> 3; z <= (end - 1) >> 3; ++z)
        for (int y = first >> 3; y <= (end - 1) >> 3; ++y)
            for (int x = first >> 3; x <= (end - 1) >> 3; ++x) {
                const auto place = fine.block(block[0] + x, block[1] + y, block[2] + z);
                const std::int32_t number = place ? fine.blocks[*place] : -1;
                if (number >= 0 || (common && *common != number)) return std::nullopt;
                common = number;
            }
    return common;
}

void number_blocks(Volume& coarse, double grids) {
    std::int32_t stored = 0;
    for (std::int32_t& block : coarse.blocks)
        if (block >= 0) block = stored++;
    check_memory(quote(coarse.info.grid), grids * stored * coarse.info.channels * Volume::block_voxels * sizeof(float),
                 "a coarser level, which footprint = false does without,");
    coarse.voxels.resize(static_cast<std::size_t>(stored) * static_cast<std::size_t>(coarse.info.channels) *
                         Volume::block_voxels);
}

float* channel_of(Volume& volume, std::size_t place, int c) {
    const auto number = static_cast<std::size_t>(volume.blocks[place]);
    return volume.voxels.data() +
           (number * static_cast<std::size_t>(volume.info.channels) + static_cast<std::size_t>(c)) *
               Volume::block_voxels;
}

Volume half_of(const Volume& fine) {
    Volume coarse = coarse_box(fine, fine.info.channels, 0);
    coarse.constants = fine.constants;
    for_each_block(coarse, [&](std::size_t place, const std::array<int, 3>& block) {
        coarse.blocks[place] = common_constant(fine, block, 0, 2 * kEdge).value_or(0);
    });
    number_blocks(coarse);
    for_each_block(coarse, [&](std::size_t place, const std::array<int, 3>& block) {
        if (coarse.blocks[place] < 0) return;
        for (int c = 0; c < fine.info.channels; ++c) {
            float* out = channel_of(coarse, place, c);
            for (int z = 0; z < 2 * kEdge; z += 2)
                for (int y = 0; y < 2 * kEdge; y += 2)
                    for (int x = 0; x < 2 * kEdge; x += 2) {
                        double sum = 0;
                        for (int k = 0; k < 8; ++k)
                            sum += static_cast<double>(fine.at(kEdge * block[0] + x + (k & 1),
                                                               kEdge * block[1] + y + (k >> 1 & 1),
                                                               kEdge * block[2] + z + (k >> 2), c));
                        *out++ = static_cast<float>(sum / 8);
                    }
        }
    });
    return coarse;
}

}  // namespace wrinkle
