#pragma once

#include <algorithm>

#include "base/vec.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {

/// Whether two directions span a plane.
inline bool crosses(const Vec3& a, const Vec3& b) {
    const double square = dot(a, a) * dot(b, b);
    return dot(cross(a, b), cross(a, b)) > 1e-12 * square;
}

/// Below this an extent, in metres or radians, shows nothing, and its square would be lost in floats.
inline constexpr double kLeastExtent = 1e-6;

/// Whether a light is lit as one with an extent.
inline bool has_extent(const Light& light) {
    switch (light.kind) {
        case LightKind::sun:
            return light.angle > kLeastExtent;
        case LightKind::sphere:
            return light.radius > kLeastExtent;
        case LightKind::disc:
        case LightKind::rectangle:
            return true;
        default:
            return false;
    }
}

/// Whether surfaces show a sky as highlights: a kernel is compiled for each that they do.
inline bool is_mirrored(const Light& light) {
    return light.kind == LightKind::sky && light.highlights && !(light.harmonics && light.texture.empty());
}

/// Whether any light of a scene is: kernels are compiled for that.
inline bool any_extent(const Lighting& lighting) {
    return std::ranges::any_of(lighting.lights, has_extent) ||
           (lighting.table && std::ranges::any_of(*lighting.table, has_extent));
}

}  // namespace wrinkle::scene
