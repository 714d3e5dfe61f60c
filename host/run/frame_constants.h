#pragma once

#include <vector>

#include "plan/plan.h"

#ifndef WR_SCALAR
#define WR_SCALAR double
#endif
#include "layout.h"

namespace wrinkle {

/// Everything kernels read that depends on the camera, in double; positions relative to the eye.
struct FrameConstants {
    wr_frame frame{};
    std::vector<double> origins;  ///< 4 numbers an origin
    std::vector<wr_decal> decals;
    wr_lighting lighting{};
    std::vector<wr_light> lights;
};

FrameConstants frame_constants(const Plan& plan, const Lighting& lighting, const Camera& camera, Size size);

}  // namespace wrinkle
