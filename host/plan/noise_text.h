#pragma once

#include "plan/layer_text.h"

namespace wrinkle {

/// The noise of a layer: its own, or that of a plane of a triplanar projection.
using NoiseOf = std::function<const NoiseLayer&(const Layer&)>;

/// Where a noise lies: three coordinates in metres, axes . p + offset, p in the world.
struct NoiseAxes {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 offset{};
};

/// The space that a noise is evaluated in, and its kernel text.
struct NoiseSpace {
    std::function<NoiseAxes(const Layer&)> axes = [](const Layer&) { return NoiseAxes{}; };
    std::string point = "p";  ///< axes . p, p relative to the eye
    std::string footprint = "wr_footprint_size(dp_dx, dp_dy)", active = "active";
    std::string step = "dp_dx";  ///< axes . dp_dx
    bool pairs = false;          ///< of floats place p in the lattice; only of the world's axes
};

/// Declares `f`, the value of a noise and its gradient along those coordinates.
std::string noise_over(LayerText& at, const NoiseOf& of, const NoiseSpace& space);

}  // namespace wrinkle
