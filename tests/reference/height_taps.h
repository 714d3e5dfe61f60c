#pragma once

#include "tests/reference/height_slope.h"

namespace wrinkle::reference {

/// [Mik20 listing 7] Change of a height map from pixel to pixel: three samples.
template <class T>
Vec2<T> height_taps(const Pyramid<T>& height, Vec2<T> st, TexDerivative<T> d, T lod, Address wrap) {
    const auto at = [&](Vec2<T> where) { return sample(height, 0, where, lod, wrap); };
    return {at(st + d.dx) - at(st), at(st + d.dy) - at(st)};
}

}  // namespace wrinkle::reference
