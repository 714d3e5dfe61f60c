#pragma once

#include "io/volume.h"
#include "resources/texture_heap.h"

namespace wrinkle {

/// Adds a volume as kernels read it (kernels/sources/volume.clh): blocks of 8^3 cells, each with the voxels around it
/// that its samples reach. Trilinear samples want one more voxel along each axis, 9^3 a block, 1.42 times what the file
/// holds; smooth ones one on each side, 10^3, 1.95 times. Blocks of one value are stored once.
void add_volume(TextureHeap& heap, const Volume& volume, TexelKind kind);

/// What a volume of a plan takes on the device.
struct VolumeReport {
    VolumeInfo info;
    std::array<int, 3> blocks{};  ///< of 8^3 voxels, along the axes of its box
    std::size_t stored = 0;       ///< of them; the others share blocks of one value
    std::size_t bytes = 0;
};
VolumeReport volume_report(const PlannedTexture& planned);

}  // namespace wrinkle
