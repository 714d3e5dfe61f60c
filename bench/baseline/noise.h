#pragma once

#include <array>

#include "tests/reference/perlin_permutation.h"
#include "vec.h"

namespace wrinkle::baseline {

struct NoiseSample {
    float value = 0;
    float3 gradient;
};

/// The directions that grad() of Perlin's reference implementation chooses, with the permutation already applied.
struct NoiseTables {
    std::array<std::uint8_t, 512> p{};
    std::array<float3, 512> gradient{};
    constexpr NoiseTables() {
        constexpr float g[16][3] = {{1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                                    {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1},
                                    {1, 1, 0},  {0, -1, 1},  {-1, 1, 0}, {0, -1, -1}};
        for (std::size_t i = 0; i < 512; ++i) {
            p[i] = reference::perlin_permutation[i & 255U];
            const float* row = g[p[i] & 15U];
            gradient[i] = {row[0], row[1], row[2]};
        }
    }
};
inline constexpr NoiseTables noise_tables;

inline float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
inline float fade_slope(float t) { return 30 * t * t * (t * (t - 2) + 1); }

/// Perlin's noise of 2002 with its analytic gradient. It is inlined, so a caller that ignores the value does not pay
/// for it.
inline NoiseSample perlin_noise(float3 p) {
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    const int cx = static_cast<int>(fx) & 255, cy = static_cast<int>(fy) & 255, cz = static_cast<int>(fz) & 255;
    const float x = p.x - fx, y = p.y - fy, z = p.z - fz;
    const float u = fade(x), v = fade(y), w = fade(z);
    const auto& perm = noise_tables.p;
    const int a = perm[cx] + cy, b = perm[cx + 1] + cy;
    const int aa = perm[a] + cz, ab = perm[a + 1] + cz, ba = perm[b] + cz, bb = perm[b + 1] + cz;
    const auto& g = noise_tables.gradient;
    const float3 g000 = g[aa], g100 = g[ba], g010 = g[ab], g110 = g[bb];
    const float3 g001 = g[aa + 1], g101 = g[ba + 1], g011 = g[ab + 1], g111 = g[bb + 1];
    const float n000 = dot(g000, {x, y, z}), n100 = dot(g100, {x - 1, y, z});
    const float n010 = dot(g010, {x, y - 1, z}), n110 = dot(g110, {x - 1, y - 1, z});
    const float n001 = dot(g001, {x, y, z - 1}), n101 = dot(g101, {x - 1, y, z - 1});
    const float n011 = dot(g011, {x, y - 1, z - 1}), n111 = dot(g111, {x - 1, y - 1, z - 1});

    // The gradient is the corners' gradients, interpolated, plus the slopes of the weights times the differences of the
    // corners' values.
    const float3 mean =
        lerp(lerp(lerp(g000, g100, u), lerp(g010, g110, u), v), lerp(lerp(g001, g101, u), lerp(g011, g111, u), v), w);
    const float n00 = lerp(n000, n100, u), n10 = lerp(n010, n110, u);
    const float n01 = lerp(n001, n101, u), n11 = lerp(n011, n111, u);
    const float n0 = lerp(n00, n10, v), n1 = lerp(n01, n11, v);
    const float along_x = lerp(lerp(n100 - n000, n110 - n010, v), lerp(n101 - n001, n111 - n011, v), w);
    const float along_y = lerp(n10 - n00, n11 - n01, w);
    return {lerp(n0, n1, w),
            mean + float3{fade_slope(x) * along_x, fade_slope(y) * along_y, fade_slope(z) * (n1 - n0)}};
}

}  // namespace wrinkle::baseline
