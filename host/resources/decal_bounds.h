#pragma once

#include <ImathVec.h>

#include <array>
#include <vector>

#include "resources/frame_constants.h"

namespace wrinkle {

/// Boxes around decals as kernels/bins reads them, in axes along the image.
struct DecalBounds {
    std::array<Imath::V3d, 3> axes{};  ///< right, down, forward; unit
    std::vector<float> boxes;          ///< WR_BOX_NUMBERS a decal
    std::vector<float> bounds;         ///< 6 planes of low and high corners, padded to whole sixteens
    std::vector<float> groups;         ///< the same of each sixteen, padded likewise
};

DecalBounds decal_bounds(const std::vector<wr_projector>& decals, const Camera& camera);

}  // namespace wrinkle
