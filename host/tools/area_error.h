#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error_stats.h"
#include "wrinkle/scene.h"

namespace wrinkle {

struct AreaOptions {
    std::vector<int> taps{1, 2, 4, 8, 16};  ///< of [filter], to compare
    int frame = 0;
    int sample = 400;     ///< pixels whose area is integrated
    int seed = 1;         ///< which ones
    bool bumped = false;  ///< only pixels whose normals the bumps tilt; else all that show a surface
    int repeat = 5;       ///< runs of each kernel over the frame; their median counts
    std::string device;
};

/// What so many taps cost and leave.
struct TapsError {
    int taps = 1;
    double ns = 0;       ///< a pixel of the frame, without its lighting
    ErrorStats degrees;  ///< between the normals and those of the mean gradient over each pixel's area
};

struct AreaErrors {
    std::vector<TapsError> taps;
    ErrorStats unbumped;  ///< the same of the frame's own normals
    std::size_t passed_over =
        0;              ///< drawn pixels with no area to integrate (background, rims, seams) or, where asked, no bump
    bool fp64 = false;  ///< integrated in double
};

/// Measures what normals miss of the areas that pixels show: the mean surface gradient of a sample of pixels is
/// integrated by evaluating the scene, unfiltered but for what is finer than a point, at 1024 points of each, and
/// compared with what the frame's own pass makes of it with so many taps. It judges the filter, not the shading, and
/// not what no pass can know: surfaces are taken as flat, and masks as constant, within a pixel. Throws Error.
AreaErrors measure_area(const Scene& scene, const AreaOptions& options);

}  // namespace wrinkle
