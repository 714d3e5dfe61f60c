#pragma once

#include <functional>
#include <string>
#include <vector>

#include "budget/cost_table.h"

namespace wrinkle {

struct TuneOptions {
    int repeat = 7;     ///< runs of each kernel; their median counts
    int sample = 4096;  ///< pixels whose errors are measured
    int seed = 1;
    std::function<void(const std::string&)> progress;  ///< called with what is measured next
};

/// Measures every layer of the scenes by itself, without its mask, on the first frame, in every variant that it has,
/// and the geometry with all of them: nanoseconds a pixel above the scene without layers, and degrees against double.
/// Rows of several layers hold the mean of their times and the largest of their errors. Throws Error where the device
/// has no double precision.
DeviceCosts measure_costs(const Device& device, const std::vector<Scene>& scenes, const TuneOptions& options);

/// Puts `measured` into a file of tables in place of what the same device had there for the same kinds.
void merge_costs(const std::filesystem::path& file, const DeviceCosts& measured);

}  // namespace wrinkle
