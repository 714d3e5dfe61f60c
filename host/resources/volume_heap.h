#pragma once

#include "io/volume.h"
#include "resources/texture_heap.h"

namespace wrinkle {

/// Adds a volume as kernels read it (kernels/sources/volume.clh): blocks of 8^3 cells, each with the voxels around it
/// that its samples reach. Trilinear samples want one more voxel along each axis, 9^3 a block, 1.42 times what the file
/// holds; smooth ones one on each side, 10^3, 1.95 times. Blocks of one value are stored once.
void add_volume(TextureHeap& heap, const Volume& volume, TexelKind kind);

/// Adds what a plan wants of a grid: itself and, for samples wider than a voxel, its coarser levels with the products
/// of their slopes. They get rows in heap.further, which follow the `rows` of the plan.
void add_planned_volume(TextureHeap& heap, const Volume& volume, const PlannedTexture& planned, std::size_t rows);

/// What a volume of a plan takes on the device.
struct VolumeReport {
    VolumeInfo info;
    std::array<int, 3> blocks{};  ///< of 8^3 voxels, along the axes of its box
    std::size_t stored = 0;       ///< of them; the others share blocks of one value
    std::size_t bytes = 0;        ///< of all levels
    std::size_t levels = 0;       ///< coarser ones
};
VolumeReport volume_report(const PlannedTexture& planned);

}  // namespace wrinkle
