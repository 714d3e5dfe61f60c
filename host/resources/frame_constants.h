#pragma once

#include <vector>

#include "plan/plan.h"

#include "layout.h"

namespace wrinkle {

/// Everything kernels read that depends on the camera, in double; positions relative to the eye.
struct FrameConstants {
    wr_frame frame{};
    std::vector<double> origins;  ///< 4 numbers an origin
    std::vector<wr_decal> decals;
    std::vector<wr_projector> projectors;  ///< of all tables, in the order of evaluation
    wr_lighting lighting{};
    std::vector<wr_light> lights;
};

/// The frame as kernels read it.
wr_frame camera_constants(const Camera& camera, Size size);

/// Sets the ..._low of a frame that is otherwise complete.
void split_constants(wr_frame& frame);

/// A decal as kernels read it; `scale` is signed, `texture` its number in the table.
wr_decal decal_constants(const DecalLayer& decal, double scale, std::size_t texture, const Vec3& eye);

/// A row of a table as kernels read it, without its masks; `scale` is signed.
wr_projector projector_constants(const Projector& row, const PlannedDecals::Image& image, double scale,
                                 const Vec3& eye);

FrameConstants frame_constants(const Plan& plan, const Lighting& lighting, const Camera& camera, Size size);

}  // namespace wrinkle
