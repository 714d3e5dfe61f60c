#pragma once

#include <cmath>
#include <optional>

#include "tests/reference/vec.h"
#include "wrinkle/lighting.h"

namespace wrinkle::reference {

template <class T>
Vec<T> from_array(const Vec3& a) {
    return {T(a[0]), T(a[1]), T(a[2])};
}

/// Direction to a light and the irradiance it gives at normal incidence, at world position p.
template <class T>
struct Arrival {
    Vec<T> direction, irradiance;
};

/// Share of its strength that a light keeps at a distance: (1 - (distance / range)^4)^2 [Karis 2013], and none beyond.
template <class T>
T range_window(const std::optional<double>& range, T distance) {
    if (!range) return 1;
    const T x = distance / T(*range), left = 1 - x * x * x * x;
    return x < 1 ? left * left : T(0);
}

template <class T>
Arrival<T> arrival(const Light& light, Vec<T> p) {
    const Vec<T> full = from_array<T>(light.color) * T(light.intensity);
    const Vec<T> axis = normalize(from_array<T>(light.direction));
    if (light.kind == LightKind::sun) return {-axis, full};
    const Vec<T> to = from_array<T>(light.position) - p;
    const Vec<T> l = normalize(to);
    const T r2 = dot(to, to);
    if (!(r2 > 0)) return {};
    const Vec<T> power = full * range_window(light.range, std::sqrt(r2));
    if (light.kind != LightKind::spot) return {l, power / r2};
    const T outer = std::cos(T(light.outer_angle)), inner = std::cos(T(light.inner_angle)), c = -dot(l, axis);
    const T t = inner == outer ? T(c >= outer) : saturate((c - outer) / (inner - outer));
    return {l, power * (t * t * (3 - 2 * t) / r2)};
}

}  // namespace wrinkle::reference
