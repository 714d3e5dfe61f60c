#pragma once

#include <algorithm>
#include <vector>

#include "baseline.h"
#include "vec.h"

namespace wrinkle::baseline {

/// Texels row by row from the bottom.
template <class T>
struct Grid {
    int width, height;
    std::vector<T> texels;
    const T& at(int x, int y) const { return texels[static_cast<std::size_t>(y) * width + x]; }
};

/// A mip pyramid. Every level has a border of one texel, wrapped or repeated, so that bilinear samples need no wrapping
/// and their pairs of texels are neighbours in memory.
template <class T>
class Pyramid {
public:
    /// `levels` finest first.
    Pyramid(const std::vector<Grid<T>>& levels, Wrap wrap);

    int width() const { return width_; }
    int height() const { return height_; }
    float top() const { return static_cast<float>(last_); }
    /// Texels of the finest level, row by row from its border at the bottom left; width() + 2 a row.
    const T* finest() const { return texels_.data(); }

    T trilinear(float2 st, float lod) const {
        st = wrap_ == Wrap::repeat ? float2{st.x - std::floor(st.x), st.y - std::floor(st.y)}
                                   : float2{clamp01(st.x), clamp01(st.y)};
        const unsigned fine = std::min(static_cast<unsigned>(static_cast<int>(lod)), last_);
        const float t = lod - static_cast<float>(static_cast<int>(fine));
        const T a = bilinear(levels_[fine], st);
        return t > 0.0F ? lerp(a, bilinear(levels_[fine + 1], st), t) : a;
    }

private:
    struct Level {
        unsigned width, height, stride;
        float fwidth, fheight;
        std::size_t offset;
    };

    T bilinear(const Level& level, float2 st) const {
        // Centres of texels lie half a texel in, and the border adds one: coordinates are never negative, so truncation
        // is floor. The minimum also keeps indices within the texture where coordinates were NaN.
        const float x = st.x * level.fwidth + 0.5F, y = st.y * level.fheight + 0.5F;
        const unsigned ix = std::min(static_cast<unsigned>(static_cast<int>(x)), level.width);
        const unsigned iy = std::min(static_cast<unsigned>(static_cast<int>(y)), level.height);
        const T* row0 = texels_.data() + level.offset + std::size_t{iy} * level.stride + ix;
        const T* row1 = row0 + level.stride;
        const float tx = x - static_cast<float>(static_cast<int>(ix)),
                    ty = y - static_cast<float>(static_cast<int>(iy));
        return lerp(lerp(row0[0], row0[1], tx), lerp(row1[0], row1[1], tx), ty);
    }

    int width_, height_;
    Wrap wrap_;
    unsigned last_;
    std::vector<Level> levels_;  ///< the last one twice, so that every level has a coarser one
    std::vector<T> texels_;
};

/// The level of detail of a footprint, and its side in texels of level 0, which is 2^lod.
struct Footprint {
    float lod = 0, texels = 1;
};

/// CalculateLevelOfDetail() of the listings, 0.5 log2 of the larger squared length, less log2(sqrt(3)), at which a
/// bilinear sample blurs as much as the pixel does; in [0, top].
inline Footprint footprint(float2 dst_dx, float2 dst_dy, int width, int height, float top) {
    const float w = static_cast<float>(width), h = static_cast<float>(height);
    const float2 a{dst_dx.x * w, dst_dx.y * h}, b{dst_dy.x * w, dst_dy.y * h};
    const float texels2 = std::fmax(dot(a, a), dot(b, b)) / 3;
    if (!(texels2 > 1.0F)) return {};
    const float lod = 0.5F * std::log2(texels2);
    if (!(lod < top)) return {top, std::exp2(top)};
    return {lod, std::sqrt(texels2)};
}

/// Channel 0 of an image: for masks, and for heights that are differenced at every sample.
Pyramid<float> scalar_pyramid(const Image& image, Wrap wrap);

/// dh/ds, dh/dt by the Sobel operator [Mik20 eq. 20, 21]. The smooth half of listing 16 computes them at every sample,
/// from 4x4 heights; computed once at load, a sample reads 4 texels instead of 16. Mips are means of slopes.
Pyramid<float2> height_slope_pyramid(const Image& image, Wrap wrap);

/// Listing 2 for every texel, at load: a sample then needs no division and one channel less. Mips are means of slopes.
Pyramid<float2> normal_slope_pyramid(const Image& image, Wrap wrap, bool y_down);

/// The plain half of listing 16, times the texture's size: dh/ds, dh/dt.
inline float2 plain_height_slope(const Pyramid<float>& height, float2 st, Footprint foot) {
    const float w = static_cast<float>(height.width()), h = static_cast<float>(height.height());
    const float right = height.trilinear({st.x + foot.texels / w, st.y}, foot.lod);
    const float up = height.trilinear({st.x, st.y + foot.texels / h}, foot.lod);
    const float centre = height.trilinear(st, foot.lod);
    const float inverse = 1.0F / foot.texels;
    return {(right - centre) * (w * inverse), (up - centre) * (h * inverse)};
}

}  // namespace wrinkle::baseline
