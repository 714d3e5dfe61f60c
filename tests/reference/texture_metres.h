#pragma once

#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// Metres of surface for a unit of texture coordinate: the root of the area that a pixel covers on the surface, divided
/// by the area that it covers in the texture. 0 when it covers none there.
template <class T>
T texture_metres(Vec<T> dp_dx, Vec<T> dp_dy, const TexDerivative<T>& st) {
    const T texture = std::abs(st.dx.x * st.dy.y - st.dx.y * st.dy.x);
    return texture > 0 ? std::sqrt(length(cross(dp_dx, dp_dy)) / texture) : T(0);
}

}  // namespace wrinkle::reference
