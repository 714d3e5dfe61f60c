#pragma once

#include <array>

#include "tests/reference/perlin_permutation.h"
#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// A value and its gradient.
template <class T>
struct NoiseValue {
    T value{};
    Vec<T> gradient;
};

/// The direction of Perlin's grad(hash, ...): one of the 12 edge middles of a cube, four of them twice.
template <class T>
Vec<T> perlin_direction(int hash) {
    const int h = hash & 15;
    std::array<T, 3> g{};
    const int u = h < 8 ? 0 : 1;
    const int v = h < 4 ? 1 : (h == 12 || h == 14 ? 0 : 2);
    g[u] += (h & 1) == 0 ? T(1) : T(-1);
    g[v] += (h & 2) == 0 ? T(1) : T(-1);
    return {g[0], g[1], g[2]};
}

/// Perlin, "Improving Noise", SIGGRAPH 2002: the sum over the 8 corners of a lattice cell of w(dx) w(dy) w(dz) (g . d),
/// where w is the fade 1 - (6t^5 - 15t^4 + 10t^3); the gradient follows by the product rule. With `cubic`, the fade is
/// that of "An Image Synthesizer", SIGGRAPH 1985: 1 - (3t^2 - 2t^3).
template <class T>
NoiseValue<T> perlin_noise(Vec<T> p, bool cubic = false) {
    const std::array<T, 3> x{p.x, p.y, p.z};
    std::array<int, 3> cell{};
    std::array<std::array<T, 2>, 3> w{}, dw{}, d{};
    for (int i = 0; i < 3; ++i) {
        const T f = std::floor(x[i]), t = x[i] - f;
        const T m = std::fmod(f, T(256));
        cell[i] = static_cast<int>(m < 0 ? m + 256 : m);
        const T fade = cubic ? t * t * (3 - 2 * t) : t * t * t * (t * (t * 6 - 15) + 10);
        const T slope = cubic ? 6 * t * (1 - t) : 30 * t * t * (t - 1) * (t - 1);
        w[i] = {1 - fade, fade};
        dw[i] = {-slope, slope};
        d[i] = {t, t - 1};
    }
    const auto perm = [](int i) { return int{perlin_permutation[i & 255]}; };
    NoiseValue<T> n;
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
        const int hash = perm(perm(perm(cell[0] + i) + cell[1] + j) + cell[2] + k);
        const Vec<T> g = perlin_direction<T>(hash);
        const T ramp = g.x * d[0][i] + g.y * d[1][j] + g.z * d[2][k];
        const T weight = w[0][i] * w[1][j] * w[2][k];
        n.value += weight * ramp;
        n.gradient =
            n.gradient + g * weight +
            Vec<T>{dw[0][i] * w[1][j] * w[2][k], w[0][i] * dw[1][j] * w[2][k], w[0][i] * w[1][j] * dw[2][k]} * ramp;
    }
    return n;
}

}  // namespace wrinkle::reference
