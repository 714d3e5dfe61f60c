#pragma once

#include "tests/reference/resolve.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::reference {

/// [Gustavson 2021, eq. 3] The displaced point.
template <class T>
Vec<T> displaced_point(Vec<T> p, Vec<T> n, T h) {
    return p + n * h;
}

/// [Gustavson 2021, eq. 4 to 8] Its normal, as if the base normal were constant.
template <class T>
Vec<T> displaced_normal(Vec<T> n, Vec<T> dh_dp) {
    return resolve(n, surface_gradient_from_volume(n, dh_dp));
}

/// [Blinn 1978, eq. 2] Its normal, from the derivatives of P + h N along two parameters. It lies on the same side as n;
/// it is n when the derivatives are parallel.
template <class T>
Vec<T> displaced_normal_curved(Vec<T> n, Vec<T> dp_dx, Vec<T> dp_dy, Vec<T> dn_dx, Vec<T> dn_dy, T h, T dh_dx,
                               T dh_dy) {
    const Vec<T> x = dp_dx + n * dh_dx + dn_dx * h, y = dp_dy + n * dh_dy + dn_dy * h;
    const Vec<T> normal = cross(x, y);
    if (is_zero(normal)) return n;
    return normalize(normal) * (dot(n, cross(dp_dx, dp_dy)) < 0 ? T(-1) : T(1));
}

}  // namespace wrinkle::reference
