#pragma once

#include <vector>

#include "plan/plan.h"

#include "layout.h"

namespace wrinkle {

/// Everything kernels read that depends on the camera or is a number of the scene, in double; positions relative to the
/// eye.
struct FrameConstants {
    wr_camera frame{};
    std::vector<double> numbers;     ///< of the scene, as planned
    std::vector<double> eye_places;  ///< 4 numbers for each that is planned
    std::vector<wr_projector> decals;
    std::vector<wr_projector> projectors;  ///< of all tables, in the order of evaluation
    wr_lighting lighting{};
    std::vector<wr_light> lights;
    std::vector<wr_light> light_table;  ///< in the order of the plan
};

/// A camera, and the frame that it fills, as kernels read them.
wr_camera camera_constants(const Camera& camera, Size size);

/// Sets the members that end in _low: what a float leaves out of the member named without it.
void split_constants(wr_camera& frame);

/// A projector as kernels read it, without its masks; `scale` is signed.
wr_projector projector_constants(const Projector& row, const ProjectedImage& image, double scale, const Vec3& eye);

/// All of them for a plan; `source` has the scene that was planned, or one that differs from it in numbers only. Throws
/// Error, naming a number that is not finite.
FrameConstants frame_constants(const Plan& plan, const NumberSource& source, const Camera& camera, Size size);

}  // namespace wrinkle
