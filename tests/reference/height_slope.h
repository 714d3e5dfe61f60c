#pragma once

#include <cstdint>

#include "tests/reference/pyramid.h"
#include "tests/reference/tangent_frame.h"

namespace wrinkle::reference {

/// The mip level of a texture w x h for screen derivatives of (s,t): 0.5 log2 of the square of the footprint's longer
/// axis, in texels, less `finer`, limited to [0, levels - 1].
template <class T>
T level_of_detail(TexDerivative<T> st, int w, int h, int levels, T finer = 0) {
    const auto squared = [&](Vec2<T> d) { return d.x * w * d.x * w + d.y * h * d.y * h; };
    const T longest = std::max(squared(st.dx), squared(st.dy));
    if (!(longest > 1)) return 0;
    return std::clamp(std::log2(longest) / 2 - finer, T(0), T(levels - 1));
}

/// By how many levels a sample is finer than the footprint is long: bilinear interpolation of means over texels blurs
/// by a variance of a quarter of a texel's square, a pixel by a twelfth of its own.
template <class T>
T filter_finer() {
    return std::log2(T(3)) / 2;
}

/// [Mik20 listing 16, isUpscaleHQ = false] dH/d(u,v) per level-0 texel: three taps 2^lod texels apart.
template <class T>
Vec2<T> plain_slope_per_texel(const Pyramid<T>& height, Vec2<T> st, T lod, Address wrap) {
    const Level<T>& top = height.levels.front();
    const T e = std::exp2(lod);
    const T c = sample(height, 0, st, lod, wrap);
    const T r = sample(height, 0, {st.x + e / top.width, st.y}, lod, wrap);
    const T u = sample(height, 0, {st.x, st.y + e / top.height}, lod, wrap);
    return {(r - c) / e, (u - c) / e};
}

/// The same per unit s and t.
template <class T>
Vec2<T> plain_slope(const Pyramid<T>& height, Vec2<T> st, T lod, Address wrap) {
    const Level<T>& top = height.levels.front();
    const Vec2<T> d = plain_slope_per_texel(height, st, lod, wrap);
    return {d.x * top.width, d.y * top.height};
}

/// The Sobel slope at a texel of a level, per texel of that level: rows of D and B of [Mik20 eq. 20, 21].
template <class T>
Vec2<T> sobel(const Level<T>& level, std::int64_t x, std::int64_t y, Address wrap) {
    const auto h = [&](int i, int j) { return level.at(0, x + i, y + j, wrap); };
    const T du = (h(1, -1) - h(-1, -1)) + 2 * (h(1, 0) - h(-1, 0)) + (h(1, 1) - h(-1, 1));
    const T dv = (h(-1, 1) - h(-1, -1)) + 2 * (h(0, 1) - h(0, -1)) + (h(1, 1) - h(1, -1));
    return {du / 8, dv / 8};
}

/// [Mik20 eq. 20, and 21 with dH/dv on its left side] Bilinear Sobel slopes of one level, per texel of that level.
template <class T>
Vec2<T> smooth_slope_per_texel(const Level<T>& level, Vec2<T> st, Address wrap) {
    const Bilinear<T> b = bilinear(level, st);
    const auto at = [&](int i, int j) { return sobel(level, b.x + i, b.y + j, wrap); };
    return (at(0, 0) * (1 - b.fx) + at(1, 0) * b.fx) * (1 - b.fy) + (at(0, 1) * (1 - b.fx) + at(1, 1) * b.fx) * b.fy;
}

/// Smooth slope per unit s and t, linear between the two levels next to lod.
template <class T>
Vec2<T> smooth_slope(const Pyramid<T>& height, Vec2<T> st, T lod, Address wrap) {
    const auto at = [&](std::size_t i) {
        const Level<T>& level = height.levels[i];
        const Vec2<T> d = smooth_slope_per_texel(level, st, wrap);
        return Vec2<T>{d.x * level.width, d.y * level.height};
    };
    const Trilinear<T> l = trilinear(height, lod);
    if (l.f == 0) return at(l.level);
    return at(l.level) * (1 - l.f) + at(l.level + 1) * l.f;
}

/// Smooth slopes per unit s and t of a whole texture: its levels are means of the finest one's slopes.
template <class T>
Pyramid<T> smooth_slopes(const Level<T>& height, Address wrap) {
    Level<T> top{height.width, height.height, {}};
    for (int c = 0; c < 2; ++c)
        for (int y = 0; y < height.height; ++y)
            for (int x = 0; x < height.width; ++x) {
                const Vec2<T> d = sobel(height, x, y, wrap);
                top.texels.push_back(c == 0 ? d.x * height.width : d.y * height.height);
            }
    return build_pyramid(std::move(top), 2);
}

/// [Mik20 listing 16, isUpscaleHQ = true] as published: the plain slope fades into the smooth one of level 0 below a
/// lod of 0.5. Per level-0 texel.
template <class T>
Vec2<T> published_slope_per_texel(const Pyramid<T>& height, Vec2<T> st, T lod, Address wrap) {
    const T start = T(1) / 2, end = T(1) / 20;
    const T mix = saturate((lod - start) / (end - start));
    const Vec2<T> plain = plain_slope_per_texel(height, st, lod, wrap);
    if (mix == 0) return plain;
    return plain * (1 - mix) + smooth_slope_per_texel(height.levels.front(), st, wrap) * mix;
}

}  // namespace wrinkle::reference
