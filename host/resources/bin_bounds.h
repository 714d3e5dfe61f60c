#pragma once

#include <ImathVec.h>

#include <array>
#include <vector>

#include "resources/frame_constants.h"

namespace wrinkle {

/// Boxes around decals, or around where lights reach, as kernels/bins reads them, in axes along the image.
struct BinBounds {
    std::array<Imath::V3d, 3> axes{};  ///< right, down, forward; unit
    std::vector<float> boxes;          ///< WR_BOX_NUMBERS a row
    std::vector<float> bounds;         ///< 6 planes of low and high corners, padded to whole sixteens
    std::vector<float> groups;         ///< the same of each sixteen, padded likewise
};

BinBounds bin_bounds(const std::vector<wr_projector>& decals, const Camera& camera);
BinBounds bin_bounds(const std::vector<wr_light>& lights, const Camera& camera);

}  // namespace wrinkle
