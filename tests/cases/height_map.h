#pragma once

#include "resources/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/height_taps.h"

namespace wrinkle::cases {

using reference::Address;
using Pyramid = reference::Pyramid<real>;

/// Adds a texture in the layout that kernels read: level by level, each with a border of one texel on every side.
/// `texel(level, channel, x, y)` is called for the border, too.
template <class Texel>
void add_texture(ColumnData& data, const Pyramid& pyramid, int channels, const Texel& texel) {
    std::vector<std::uint32_t>& table = data.textures;
    std::vector<float>& texels = data.texels;
    const std::size_t words = table.size();
    table.resize(words + WR_TEXTURE_WORDS);
    table[words + WR_TEXTURE_WIDTH] = static_cast<std::uint32_t>(pyramid.levels[0].width);
    table[words + WR_TEXTURE_HEIGHT] = static_cast<std::uint32_t>(pyramid.levels[0].height);
    table[words + WR_TEXTURE_LEVELS] = static_cast<std::uint32_t>(pyramid.levels.size());
    if (texels.size() < 4) texels.resize(4);
    for (std::size_t l = 0; l < pyramid.levels.size(); ++l) {
        texels.resize(texels.size() - 4);  // four more floats, as the last pair of a row may be read with its neighbour
        table[words + WR_TEXTURE_OFFSETS + l] = static_cast<std::uint32_t>(texels.size());
        for (int y = -1; y <= pyramid.levels[l].height; ++y)
            for (int x = -1; x <= pyramid.levels[l].width; ++x)
                for (int c = 0; c < channels; ++c)
                    texels.push_back(static_cast<float>(texel(pyramid.levels[l], c, x, y)));
        texels.resize(texels.size() + 4);
    }
}

/// Adds two textures: the heights, and their Sobel slopes per unit of texture coordinate.
inline void add_heights(ColumnData& data, const Pyramid& height, Address wrap) {
    add_texture(data, height, 1, [&](const auto& level, int, int x, int y) { return level.at(0, x, y, wrap); });
    add_texture(data, height, 2, [&](const auto& level, int c, int x, int y) {
        const V2 d = reference::sobel(level, x, y, wrap);
        return c == 0 ? d.x * level.width : d.y * level.height;
    });
}

/// Slopes are compared per texel of the finest level.
inline V2 per_texel(V2 slope, const Pyramid& height) {
    return {slope.x / height.levels[0].width, slope.y / height.levels[0].height};
}

inline std::map<std::string, Pyramid> golden_textures() {
    const GoldenTable table = reference::golden("listing16_textures");
    std::map<std::string, Pyramid> textures;
    for (std::size_t i = 0; i < table.size(); ++i) {
        reference::Level<real> level{std::stoi(table.text(i, "w")), std::stoi(table.text(i, "h")), {}};
        const std::vector<std::string>& cells = table.cells(i);
        for (std::size_t k = 4; k < cells.size(); ++k) level.texels.push_back(std::strtod(cells[k].c_str(), nullptr));
        textures[table.text(i, "tex")].levels.push_back(level);
    }
    return textures;
}

/// Listing 16 on a texture that repeats: the level of detail, the slopes at that level, and the slopes at a level that
/// is given (`lod_in`).
inline Cases height_slope_cases(bool smooth) {
    Cases c{.name = "listing16_deriv_from_heightmap"};
    c.data.constants_per_row = 1;  // the texture
    const GoldenTable table = reference::golden("listing16_deriv_from_heightmap");
    const auto textures = golden_textures();
    std::map<std::string, double> number;
    for (const auto& [name, height] : textures) {
        number[name] = static_cast<double>(2 * number.size() + (smooth ? 1 : 0));
        add_heights(c.data, height, Address::repeat);
    }
    for (std::size_t i = 0; i < table.size(); ++i)
        for (const bool given : {false, true}) {
            const auto found = textures.find(table.text(i, "tex"));
            if (found == textures.end()) continue;
            const Pyramid& height = found->second;
            const real last = real(height.levels.size() - 1);
            const real lod = given ? std::clamp<real>(table.number(i, "lod_in"), 0, last) : table.number(i, "want_lod");
            const V2 st = table.vec2(i, "st");
            add_golden_row(c, table, i, {});
            c.data.constants.push_back(number[found->first]);
            c.in("st", st), c.in("dst_dx", table.vec2(i, "dSTdx")), c.in("dst_dy", table.vec2(i, "dSTdy"));
            c.in("lod", lod);
            c.out("lod", real{table.number(i, "want_lod")});
            c.out("slope", smooth  ? per_texel(reference::smooth_slope(height, st, lod, Address::repeat), height)
                           : given ? reference::plain_slope_per_texel(height, st, lod, Address::repeat)
                                   : table.vec2(i, "want_d0"));
        }
    return c;
}

/// Listing 7 on a texture that repeats, with footprints from a billionth of the texture to several textures. The error
/// allowed grows with the number of texels that a pixel spans.
inline Cases height_tap_cases() {
    Cases c{.name = "height taps"};
    c.data.constants_per_row = 1;
    const auto textures = golden_textures();
    std::vector<const Pyramid*> heights;
    for (const auto& [name, height] : textures) {
        heights.push_back(&height);
        add_texture(c.data, height, 1,
                    [&](const auto& l, int, int x, int y) { return l.at(0, x, y, Address::repeat); });
    }
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const std::size_t which = seed % heights.size();
        const Pyramid& height = *heights[which];
        const bool hard = seed % 2 == 0;
        const real size = hard ? random.magnitude(-9, 0.5L) : random.uniform(0.001L, 0.1L);
        const auto step = [&] {
            return V2{static_cast<float>(random.uniform(-1, 1) * size),
                      static_cast<float>(random.uniform(-1, 1) * size)};
        };
        const real far = seed % 5 == 0 ? 1e5L : 2;
        V2 st{random.uniform(-far, far), random.uniform(-far, far)};
        const int w = height.levels[0].width, h = height.levels[0].height;
        if (seed % 3 == 0)  // so close to the border between two texels that steps cross it
            st = {static_cast<float>((random.below(w) + 0.5L) / w + random.uniform(-1, 1) * size / 2),
                  static_cast<float>((random.below(h) + 0.5L) / h + random.uniform(-1, 1) * size / 2)};
        const reference::TexDerivative<real> d{step(), step()};
        const real last = real(height.levels.size() - 1), lod = seed % 4 == 0 ? random.uniform(0, last) : 0;
        const real span =
            std::max({std::abs(d.dx.x) * w, std::abs(d.dx.y) * h, std::abs(d.dy.x) * w, std::abs(d.dy.y) * h});
        c.add("height taps, seed " + std::to_string(seed), hard, std::min(span, real{1}));
        c.data.constants.push_back(static_cast<double>(which));
        c.in("st", st), c.in("dst_dx", d.dx), c.in("dst_dy", d.dy), c.in("lod", lod);
        c.out("dh_dxy", reference::height_taps(height, st, d, lod, Address::repeat));
    }
    return c;
}

/// Listing 16 on a clamped picture of odd size, also at its edges and corners.
inline Cases clamped_slope_cases() {
    Cases c{.name = "clamped height slopes"};
    Random texels(7);
    reference::Level<real> top{13, 7, {}};
    for (int i = 0; i < 13 * 7; ++i) top.texels.push_back(texels.uniform(0, 1));
    const Pyramid height = reference::build_pyramid(top, 1);
    add_heights(c.data, height, Address::clamp);
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        V2 st{random.uniform(0, 1), random.uniform(0, 1)};
        if (seed % 5 == 0) st.x = real(random.below(2));
        if (seed % 7 == 0) st.y = real(random.below(2));
        const real lod = seed % 3 == 0 ? real(random.below(4)) : random.uniform(0, 3);
        c.add("clamped slope, seed " + std::to_string(seed), seed % 5 == 0 || seed % 7 == 0);
        c.in("st", st), c.in("lod", lod);
        c.out("plain", reference::plain_slope_per_texel(height, st, lod, Address::clamp));
        c.out("smooth", per_texel(reference::smooth_slope(height, st, lod, Address::clamp), height));
    }
    return c;
}

}  // namespace wrinkle::cases
