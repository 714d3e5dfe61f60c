#pragma once

#include <functional>
#include <numbers>

#include "tests/reference/noise.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

/// A voxel by its index.
template <class T>
using Voxels = std::function<T(int, int, int)>;

/// Sum over the voxels around p of weight products: `basis(d)` and `slope(d)`, its derivative, at the distance d from a
/// voxel, along each axis.
template <class T>
NoiseValue<T> spline_sum(const Voxels<T>& voxel, Vec<T> p, T (*basis)(T), T (*slope)(T)) {
    const T at[] = {p.x, p.y, p.z};
    int low[3];
    T rest[3];  // from the voxel at or below: what rounding does to it is the same for all voxels
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

/// Trilinear interpolation: hat functions. At a voxel the slope is that of the cell above.
template <class T>
NoiseValue<T> trilinear(const Voxels<T>& voxel, Vec<T> p) {
    return spline_sum<T>(
        voxel, p, [](T d) { return std::max(T(0), 1 - std::abs(d)); },
        [](T d) { return d >= -1 && d < 0  ? T(1)
                         : d >= 0 && d < 1 ? T(-1)
                                           : T(0); });
}

/// The quadratic B-spline, centred on voxels.
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

/// Height and its derivative by the value, for `remap` over a range of values.
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

/// First distance along the ray within the ball of `radius` where f changes sign, from small steps and bisection; 0
/// where there is none.
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
