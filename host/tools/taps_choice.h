#pragma once

#include <string>

#include "base/error_stats.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// What a run reports of its budget for areas.
struct TapsChoice {
    double max_area_error = 0;  ///< degrees, as the scene asks
    int taps = 1, most = 1;     ///< that were taken; those of the scene's filter
    double ns = 0;              ///< a pixel, without lighting, with the taps that were taken
    ErrorStats measured;        ///< degrees
    int seed = 0;
};

/// The fewest taps, of 1, 2, 4, ... and those of the filter, with which 99% of a sample of a frame's pixels keep the
/// scene's max_area_error (measure_area()). Throws Error where none does.
TapsChoice choose_taps(const Scene& scene, int frame, const std::string& device);

}  // namespace wrinkle
