#pragma once

#include "run/pass_impl.h"
#include "run/plane_buffers.h"

namespace wrinkle {

/// How the normal magnifies errors of its inputs, per pixel: where numbers are weak, whatever computes with them.
///
/// Every input plane in turn is moved by one float32 ulp, up or down by a hash of the pixel, and the scene evaluated in
/// double; condition is the sum of the angles by which the normal turns, in units of 2^-24 radians (3.4e-6 degrees).
/// To first order, inputs that are off by one ulp each turn the normal by no more than condition times that. It is
/// large at grazing angles, where texture coordinates degenerate, on steep slopes, far from the eye under fine bumps,
/// and where a bump jumps. Labels (object indices, Cryptomatte, the sign of tangents) are not moved; nor are 0, Inf and
/// NaN. 0 where the pixel is invalid.
class Condition {
public:
    /// Throws Error where the device has no double precision.
    Condition(const Device& device, const Scene& scene, const Frame& frame, TextureStore* store = nullptr);

    /// Planes that it reads.
    const std::vector<std::string>& inputs() const { return pass_.inputs(); }

    void set_camera(const Camera& camera) { pass_.set_camera(camera); }

    /// The condition of a band's pixels. Blocks.
    std::vector<float> evaluate(PlaneBuffers& inputs, const Rows& rows);

private:
    /// Of `inputs` once the events of `wait` are there.
    std::array<std::vector<double>, 3> normals(const DevicePlanes& inputs, std::vector<cl::Event> wait,
                                               const Rows& rows, std::size_t pixels);

    Pass pass_;
    std::size_t room_ = 0;
    PlaneBuffers moved_, outputs_;
};

}  // namespace wrinkle
