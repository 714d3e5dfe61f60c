#pragma once

#include <string>
#include <vector>

#include "measure.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// A way to sample a volume on one walk through it.
struct VolumeRow {
    std::string walk, name;
    Timing seconds;
    double ns = 0, best_ns = 0;  ///< a sample: median run, fastest run
    double ratio = 0;  ///< to NanoVDB's cached gradient on the same walk: the median of the ratios of single runs
    /// Relative error of a trilinear gradient against double: median, p99, largest.
    double median = 0, p99 = 0, max = 0;
};

/// Value and gradient on a grid of size^3 voxels, against NanoVDB's C++ in the same run. Walks: 0.2 and 1.4 voxels a
/// pixel along a plane askew to the grid, and points at random.
std::vector<VolumeRow> measure_volumes(const Device& device, int size, int repetitions);

}  // namespace wrinkle::bench
