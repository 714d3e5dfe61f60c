#pragma once

#include "tests/reference/lighting.h"

namespace wrinkle::reference {

/// What a surface mirrors of light from all directions: the sum over `steps` x 2 `steps` of them, alike in solid angle,
/// of radiance times reflectance times cosine, of those in front of the base. The pole of the directions is not the
/// normal. `radiance` gives a Vec of a direction.
template <class T, class Radiance>
Vec<T> mirrored_sky(const Radiance& radiance, Vec<T> n, Vec<T> base, Vec<T> v, const Surface<T>& s, int steps) {
    constexpr T pi = std::numbers::pi_v<T>;
    const Vec<T> mirror = mirror_normal(n, base, v);
    Vec<T> sum;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const T z = 1 - (2 * i + 1) / T(steps), turn = pi * (j + T(1) / 2) / steps, out = std::sqrt(1 - z * z);
            const Vec<T> l{out * std::cos(turn), z, out * std::sin(turn)};
            const T cosine = dot(mirror, l);
            if (!(cosine > 0) || !(dot(base, l) > 0)) continue;
            sum = sum + radiance(l) * (mirrored(mirror, v, l, s) * cosine * 2 * pi / (T(steps) * steps));
        }
    return sum;
}

}  // namespace wrinkle::reference
