#include "resources/volume_heap.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>

#include "io/volume.h"
#include "layout.h"
#include "tests/cases/sanitized.h"

namespace wrinkle {
namespace {

/// A box with leaves, constants and background, of which each is beside each.
Volume mixed(int channels) {
    Volume volume;
    volume.info.channels = channels;
    volume.first = {-2, 5, 1}, volume.count = {5, 3, 4};
    volume.constants = {0.5F, 0.25F, 0, 2, 3, 4};
    const std::size_t blocks = 5 * 3 * 4;
    std::int32_t leaves = 0;
    for (std::size_t i = 0; i < blocks; ++i) volume.blocks.push_back(i % 7 == 0 ? leaves++ : i % 3 == 0 ? -2 : -1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(leaves * channels) * Volume::block_voxels; ++i)
        volume.voxels.push_back(static_cast<float>(i));
    return volume;
}

/// Every block of the index begins with the voxels that its cells need.
void expect_whole(const Volume& volume, TexelKind kind, int edge, int before) {
    TextureHeap heap;
    heap.texels = {7, 8, 9};  // of textures before it
    add_volume(heap, volume, kind);
    const std::uint32_t* words = heap.table.data();
    std::size_t at = words[WR_VOLUME_INDEX];
    const auto first = [&](std::size_t axis) { return static_cast<int>(words[WR_VOLUME_FIRST + axis]); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(first(axis), 8 * (volume.first[axis] - 2));
        EXPECT_EQ(words[WR_VOLUME_BLOCKS + axis], static_cast<std::uint32_t>(volume.count[axis] + 4));
    }
    for (std::uint32_t z = 0; z < words[WR_VOLUME_BLOCKS + 2]; ++z)
        for (std::uint32_t y = 0; y < words[WR_VOLUME_BLOCKS + 1]; ++y)
            for (std::uint32_t x = 0; x < words[WR_VOLUME_BLOCKS]; ++x) {
                auto voxel = static_cast<std::size_t>(std::bit_cast<std::int32_t>(heap.texels[at++]));
                for (int c = 0; c < volume.info.channels; ++c)
                    for (int k = -before; k < edge - before; ++k)
                        for (int j = -before; j < edge - before; ++j)
                            for (int i = -before; i < edge - before; ++i)
                                ASSERT_EQ(heap.texels.at(voxel++), volume.at(first(0) + 8 * static_cast<int>(x) + i,
                                                                             first(1) + 8 * static_cast<int>(y) + j,
                                                                             first(2) + 8 * static_cast<int>(z) + k, c))
                                    << x << " " << y << " " << z;
            }
}

TEST(VolumeHeap, HoldsWhatSamplesReach) {
    expect_whole(mixed(1), TexelKind::volume, 9, 0);
    expect_whole(mixed(1), TexelKind::volume_smooth, 10, 1);
    expect_whole(mixed(3), TexelKind::volume, 9, 0);
}

/// Two voxels far apart: their blocks and those around them are stored, not the 8 million of the box.
TEST(VolumeHeap, TakesTimeForWhatIsThere) {
    Volume volume;
    volume.count = {200, 200, 200};
    volume.blocks.assign(200 * 200 * 200, -1);
    volume.blocks.front() = 0, volume.blocks.back() = 1;
    volume.voxels.assign(2 * Volume::block_voxels, 1);
    TextureHeap heap;
    const auto began = std::chrono::steady_clock::now();
    add_volume(heap, volume, TexelKind::volume_smooth);
    if (!test::kSanitized) { EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(20)); }
    EXPECT_LT(heap.texels.size(), 204u * 204 * 204 + 100'000);
    volume.blocks.assign(200 * 200 * 200, -2);
    volume.constants.insert(volume.constants.end(), {1, 0, 0});
    TextureHeap constant;
    const auto again = std::chrono::steady_clock::now();
    add_volume(constant, volume, TexelKind::volume_smooth);
    if (!test::kSanitized) { EXPECT_LT(std::chrono::steady_clock::now() - again, std::chrono::seconds(30)); }
}

}  // namespace
}  // namespace wrinkle
