#pragma once

#include <array>
#include <cstdint>

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// The permutation of Perlin's reference implementation of improved noise, 2002.
inline constexpr std::array<std::uint8_t, 256> perlin_permutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

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

/// Perlin, "Improving Noise", SIGGRAPH 2002: the sum over the 8 corners of a lattice cell of
/// w(dx) w(dy) w(dz) (g . d), w the fade polynomial 1 - (6t^5 - 15t^4 + 10t^3); the gradient is its product rule.
/// With `cubic` the fade of "An Image Synthesizer", SIGGRAPH 1985: 1 - (3t^2 - 2t^3).
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
