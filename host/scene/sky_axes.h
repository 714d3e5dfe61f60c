#pragma once

#include <cmath>

#include "base/vec.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {

/// The axes of a sky's picture in world space: towards its middle, towards what is left of that, and to its top.
struct SkyAxes {
    Vec3 ahead, aside, up;
};

inline SkyAxes sky_axes(const Light& light) {
    const Vec3 up = normalize(light.up), x{1, 0, 0};
    const Vec3 left = normalize(cross(up, parallel(up, x) ? Vec3{0, 1, 0} : x)), front = cross(left, up);
    const double cosine = std::cos(light.rotation), sine = std::sin(light.rotation);
    SkyAxes axes{{}, {}, up};
    for (std::size_t i = 0; i < 3; ++i) {
        axes.ahead[i] = front[i] * cosine + left[i] * sine;
        axes.aside[i] = left[i] * cosine - front[i] * sine;
    }
    return axes;
}

}  // namespace wrinkle::scene
