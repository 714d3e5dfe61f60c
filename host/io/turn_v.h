#pragma once

#include <span>
#include <string_view>

namespace wrinkle::io {

/// Texture coordinates that grow downwards become such that grow upwards; so do their derivatives.
inline void turn_v(std::string_view plane, std::span<float> values) {
    if (plane == "uv.v")
        for (float& value : values) value = 1 - value;
    else if (plane == "duv_dx.v" || plane == "duv_dy.v" || plane.starts_with("dp_dv."))
        for (float& value : values) value = -value;
}

}  // namespace wrinkle::io
