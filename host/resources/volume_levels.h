#pragma once

#include <vector>

#include "io/volume.h"

namespace wrinkle {

/// Coarser levels of a grid, for samples wider than a voxel. Voxel j of level k is the mean of the voxels j 2^k to
/// (j + 1) 2^k - 1 of the grid, along each axis; so it lies at (j + 1/2) 2^k - 1/2 in the grid's index space. The last
/// level is the first on which the grid's box is two voxels wide at most.
std::vector<Volume> coarser_levels(const Volume& volume);

}  // namespace wrinkle
