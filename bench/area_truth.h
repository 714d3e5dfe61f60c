#pragma once

#include "area_surfaces.h"
#include "base/error_stats.h"

namespace wrinkle::bench {

using Vectors = std::vector<std::array<double, 3>>;

/// The surface's own normals, a pixel each.
Vectors own_normals(const AreaSurface& surface);

/// The normals that the mean surface gradient over the area of some pixels makes, by the double-precision reference at
/// 1024 points of each.
class AreaTruth {
public:
    AreaTruth(const AreaSurface& surface, Scene scene);

    /// Errors of a frame's normals, which need not be of unit length.
    ErrorStats compare(const Vectors& got) const;

private:
    std::vector<std::size_t> pixels_;
    Vectors normals_;
};

}  // namespace wrinkle::bench
