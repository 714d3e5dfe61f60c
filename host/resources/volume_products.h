#pragma once

#include <vector>

#include "io/volume.h"
#include "wrinkle/layers.h"

namespace wrinkle {

/// The products of the slopes that a level averages, for the same levels: means over all cells, or voxels, that lie in
/// a voxel of the level. Their difference to the products of the mean slope is the slopes' covariance.
struct SlopeProducts {
    Volume first, second;  ///< xx, xy, xz and yy, yz, zz, as grids of vectors, per voxel of the finest grid
};

/// Slopes are those of the interpolated values: trilinear ones, whose cells lie between voxels, so that voxel j of
/// level k lies at (j + 1/2) 2^k; or of the quadratic B-spline, whose cells lie around voxels. A grid of vectors holds
/// slopes.
std::vector<SlopeProducts> product_levels(const Volume& volume, VolumeFilter filter, std::size_t levels);

}  // namespace wrinkle
