#pragma once

#include <functional>
#include <numbers>

#include "tests/reference/noise.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

/// A voxel by its index.
template <class T>
using Voxels = std::function<T(int, int, int)>;

/// Value and gradient at p, as a sum over the voxels around. A voxel's weight is the product of basis(d) over the three
/// axes, where d is its distance along the axis; slope(d) is the derivative of basis(d).
template <class T>
NoiseValue<T> spline_sum(const Voxels<T>& voxel, Vec<T> p, T (*basis)(T), T (*slope)(T)) {
    const T at[] = {p.x, p.y, p.z};
    int low[3];
    T rest[3];  // distance from the voxel at or below p, rounded only once for all voxels
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = static_cast<int>(std::floor(at[axis])) - 1;
        rest[axis] = at[axis] - std::floor(at[axis]);
    }
    NoiseValue<T> sum;
    for (int k = 0; k < 64; ++k) {
        const int step[] = {k & 3, k >> 2 & 3, k >> 4};
        T w[3], dw[3];
        for (int axis = 0; axis < 3; ++axis) {
            w[axis] = basis(rest[axis] - T(step[axis] - 1));
            dw[axis] = slope(rest[axis] - T(step[axis] - 1));
        }
        const T v = voxel(low[0] + step[0], low[1] + step[1], low[2] + step[2]);
        sum.value += w[0] * w[1] * w[2] * v;
        sum.gradient = sum.gradient + Vec<T>{dw[0] * w[1] * w[2], w[0] * dw[1] * w[2], w[0] * w[1] * dw[2]} * v;
    }
    return sum;
}

/// Trilinear interpolation, whose basis are hat functions. Exactly at a voxel, the slope is that of the cell above.
template <class T>
NoiseValue<T> trilinear(const Voxels<T>& voxel, Vec<T> p) {
    return spline_sum<T>(
        voxel, p, [](T d) { return std::max(T(0), 1 - std::abs(d)); },
        [](T d) { return d >= -1 && d < 0  ? T(1)
                         : d >= 0 && d < 1 ? T(-1)
                                           : T(0); });
}

/// The quadratic B-spline, with its knots halfway between voxels.
template <class T>
NoiseValue<T> quadratic_spline(const Voxels<T>& voxel, Vec<T> p) {
    return spline_sum<T>(
        voxel, p,
        [](T d) {
            const T a = std::abs(d), rest = T(3) / 2 - a;
            return a < T(1) / 2 ? T(3) / 4 - a * a : a < T(3) / 2 ? rest * rest / 2 : T(0);
        },
        [](T d) {
            const T a = std::abs(d), sign = d < 0 ? T(-1) : T(1);
            return a < T(1) / 2 ? -2 * d : a < T(3) / 2 ? -sign * (T(3) / 2 - a) : T(0);
        });
}

/// The height for a value of the volume, and its derivative by the value, for a `remap` over a range.
template <class T>
Vec2<T> remapped(Remap remap, T value, T low, T high) {
    const T t = (value - low) / (high - low), s = saturate(t), pi = std::numbers::pi_v<T>;
    switch (remap) {
        case Remap::ramp:
            return {s, t > 0 && t < 1 ? 1 / (high - low) : T(0)};
        case Remap::smooth:
            return {3 * s * s - 2 * s * s * s, (6 * s - 6 * s * s) / (high - low)};
        case Remap::wave:
            return {std::sin(2 * pi * t), 2 * pi * std::cos(2 * pi * t) / (high - low)};
        case Remap::none:
            break;
    }
    return {value, T(1)};
}

/// f = 2 - (cos(x + Ty) + cos(x - Ty) + cos(y + Tz) + cos(y - Tz) + cos(z - Tx) + cos(z + Tx)), T the golden ratio.
template <class T>
NoiseValue<T> golden_ratio(Vec<T> p) {
    const T t = std::numbers::phi_v<T>;
    NoiseValue<T> f{2, {}};
    const Vec<T> phases[] = {{1, t, 0}, {1, -t, 0}, {0, 1, t}, {0, 1, -t}, {-t, 0, 1}, {t, 0, 1}};
    for (const Vec<T>& k : phases) {
        f.value -= std::cos(dot(k, p));
        f.gradient = f.gradient + k * std::sin(dot(k, p));
    }
    return f;
}

/// The first distance along a ray, within a ball of that radius, at which f changes sign; by small steps and bisection.
/// 0 when there is none.
template <class T>
T golden_distance(Vec<T> eye, Vec<T> ray, T radius) {
    const auto f = [&](T t) { return golden_ratio(eye + ray * t).value; };
    const T middle = -dot(eye, ray), chord = radius * radius - (dot(eye, eye) - middle * middle);
    if (!(chord > 0)) return 0;
    const T last = middle + std::sqrt(chord), step = T(1) / 256;
    T t = std::max(T(0), middle - std::sqrt(chord));
    for (; t < last; t += step) {
        if (f(t) < 0 || f(t + step) >= 0) continue;
        T low = t, high = t + step;
        for (int i = 0; i < 80; ++i) {
            const T half = (low + high) / 2;
            (f(half) < 0 ? high : low) = half;
        }
        return low;
    }
    return 0;
}

}  // namespace wrinkle::reference
