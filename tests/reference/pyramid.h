#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// A picture. Row 0 is at the bottom (t = 0); channels are interleaved.
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> texels;
};

enum class Address { repeat, clamp };

/// One mip level, channel after channel.
template <class T>
struct Level {
    int width = 0, height = 0;
    std::vector<T> texels;

    T at(int channel, std::int64_t x, std::int64_t y, Address wrap) const {
        const auto index = [&](std::int64_t i, std::int64_t n) {
            if (wrap == Address::clamp) return std::clamp<std::int64_t>(i, 0, n - 1);
            return ((i % n) + n) % n;
        };
        return texels[(static_cast<std::size_t>(channel) * height + index(y, height)) * width + index(x, width)];
    }
};

template <class T>
struct Pyramid {
    int channels = 1;
    std::vector<Level<T>> levels;
};

/// The share of texel k of n, as intervals of [0, 1], that cell i of m covers.
template <class T>
T covered_share(int k, int n, int i, int m) {
    const T from = std::max(T(k) / n, T(i) / m), to = std::min(T(k + 1) / n, T(i + 1) / m);
    return std::max(to - from, T(0)) * m;
}

/// The next mip level. Its sides are half as long, rounded down, and at least 1. Each texel is the mean over the area
/// that it covers: of 2x2 texels, and of parts of a third where a side is odd.
template <class T>
Level<T> half_size(const Level<T>& fine, int channels) {
    Level<T> coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    coarse.texels.reserve(static_cast<std::size_t>(channels) * coarse.width * coarse.height);
    for (int c = 0; c < channels; ++c)
        for (int y = 0; y < coarse.height; ++y)
            for (int x = 0; x < coarse.width; ++x) {
                T mean = 0;
                for (int j = 2 * y; j < std::min(2 * y + 4, fine.height); ++j)
                    for (int i = 2 * x; i < std::min(2 * x + 4, fine.width); ++i)
                        mean += covered_share<T>(i, fine.width, x, coarse.width) *
                                covered_share<T>(j, fine.height, y, coarse.height) * fine.at(c, i, j, Address::clamp);
                coarse.texels.push_back(mean);
            }
    return coarse;
}

template <class T>
Pyramid<T> build_pyramid(Level<T> top, int channels) {
    Pyramid<T> pyramid{channels, {std::move(top)}};
    while (pyramid.levels.back().width > 1 || pyramid.levels.back().height > 1)
        pyramid.levels.push_back(half_size(pyramid.levels.back(), channels));
    return pyramid;
}

/// First channel of an image.
template <class T>
Pyramid<T> first_channel_pyramid(const Image& image) {
    Level<T> top{image.width, image.height, {}};
    for (std::size_t i = 0; i < image.texels.size(); i += image.channels) top.texels.push_back(image.texels[i]);
    return build_pyramid(std::move(top), 1);
}

/// The texel at the lower left of a sample, and how far the sample is on the way to the next one. The centre of texel i
/// is at (i + .5) / width.
template <class T>
struct Bilinear {
    std::int64_t x, y;
    T fx, fy;
};

template <class T>
Bilinear<T> bilinear(const Level<T>& level, Vec2<T> st) {
    const T half = T(1) / 2;
    const T u = st.x * level.width - half, v = st.y * level.height - half;
    const T x = std::floor(u), y = std::floor(v);
    return {static_cast<std::int64_t>(x), static_cast<std::int64_t>(y), u - x, v - y};
}

template <class T>
T sample_level(const Level<T>& level, int channel, Vec2<T> st, Address wrap) {
    const Bilinear<T> b = bilinear(level, st);
    const auto at = [&](int i, int j) { return level.at(channel, b.x + i, b.y + j, wrap); };
    return (at(0, 0) * (1 - b.fx) + at(1, 0) * b.fx) * (1 - b.fy) + (at(0, 1) * (1 - b.fx) + at(1, 1) * b.fx) * b.fy;
}

/// The finer one of the two levels next to a lod, and the weight of the coarser one. The lod is clamped to the levels
/// that there are.
template <class T>
struct Trilinear {
    std::size_t level;
    T f;
};

template <class T>
Trilinear<T> trilinear(const Pyramid<T>& pyramid, T lod) {
    const T last = T(pyramid.levels.size() - 1);
    const T l = std::fmin(std::fmax(lod, T(0)), last);
    const T floor = std::floor(l);
    return {static_cast<std::size_t>(floor), l - floor};
}

template <class T>
T sample(const Pyramid<T>& pyramid, int channel, Vec2<T> st, T lod, Address wrap) {
    const Trilinear<T> l = trilinear(pyramid, lod);
    const T fine = sample_level(pyramid.levels[l.level], channel, st, wrap);
    if (l.f == 0) return fine;
    return fine * (1 - l.f) + sample_level(pyramid.levels[l.level + 1], channel, st, wrap) * l.f;
}

}  // namespace wrinkle::reference
