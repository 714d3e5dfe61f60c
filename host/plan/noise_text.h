#pragma once

#include "plan/layer_text.h"

namespace wrinkle {

/// The noise of a layer: its own, or that of a plane of a triplanar projection.
using NoiseOf = std::function<const NoiseLayer&(const Layer&)>;

/// The coordinates that a noise is a function of: axes . p + offset, metres, for p in world space.
struct NoiseAxes {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 offset{};
};

/// The space that a noise is evaluated in, and its kernel text.
struct NoiseSpace {
    std::function<NoiseAxes(const Layer&)> axes = [](const Layer&) { return NoiseAxes{}; };
    std::string point = "p";  ///< axes . p, p relative to the eye
    std::string footprint = "wr_footprint_size(dp_dx, dp_dy)", active = "active";
    std::string step = "dp_dx";  ///< axes . dp_dx: from point to point of the pixel's area
    bool pairs = false;  ///< p is a sum of two floats, for more digits in the lattice; only with the world's axes
};

/// Text that declares `f`: the value of a noise, and its gradient over these coordinates.
std::string noise_over(LayerText& at, const NoiseOf& of, const NoiseSpace& space);

}  // namespace wrinkle
