// Height slopes against listing 16's golden table, and the mip rule.
#include <gtest/gtest.h>

#include "tests/reference/golden.h"
#include "tests/reference/height_slope.h"

namespace wrinkle::reference {
namespace {

std::map<std::string, Pyramid<real>> golden_textures() {
    const GoldenTable table = golden("listing16_textures");
    std::map<std::string, Pyramid<real>> textures;
    for (std::size_t i = 0; i < table.size(); ++i) {
        Level<real> level{std::stoi(table.text(i, "w")), std::stoi(table.text(i, "h")), {}};
        const std::vector<std::string>& cells = table.cells(i);
        for (std::size_t k = 4; k < cells.size(); ++k) level.texels.push_back(std::strtod(cells[k].c_str(), nullptr));
        textures[table.text(i, "tex")].levels.push_back(level);
    }
    return textures;
}

/// Slopes are differences of heights near 1. Errors are relative to the slope, or to one of 1e-3 per texel where it is
/// flatter.
void expect_slope(Vec2<real> got, Vec2<real> want, const std::string& label) {
    const real size = std::max(std::hypot(want.x, want.y), 1e-3L);
    EXPECT_LE(std::hypot(got.x - want.x, got.y - want.y) / size, 1e-12L) << label;
}

TEST(Golden, HeightSlope) {
    const GoldenTable table = golden("listing16_deriv_from_heightmap");
    const std::map<std::string, Pyramid<real>> textures = golden_textures();
    for (std::size_t i = 0; i < table.size(); ++i) {
        const auto texture = textures.find(table.text(i, "tex"));
        if (texture == textures.end()) continue;
        const Pyramid<real>& height = texture->second;
        const Level<real>& top = height.levels.front();
        const Vec2<real> st = table.vec2(i, "st");
        const TexDerivative<real> d{table.vec2(i, "dSTdx"), table.vec2(i, "dSTdy")};
        const real lod = level_of_detail(d, top.width, top.height, static_cast<int>(height.levels.size()));
        EXPECT_NEAR(lod, table.number(i, "want_lod"), 1e-12L) << table.label(i);
        const auto plain = [&](real l) { return plain_slope_per_texel(height, st, l, Address::repeat); };
        const auto smooth = [&](real l) { return published_slope_per_texel(height, st, l, Address::repeat); };
        expect_slope(plain(lod), table.vec2(i, "want_d0"), "d0, " + table.label(i));
        expect_slope(smooth(lod), table.vec2(i, "want_dHQ"), "dHQ, " + table.label(i));
        const real given = std::max<real>(table.number(i, "lod_in"), 0);
        expect_slope(plain(given), table.vec2(i, "want_dL0"), "dL0, " + table.label(i));
        expect_slope(smooth(given), table.vec2(i, "want_dLHQ"), "dLHQ, " + table.label(i));
    }
}

/// The program that made the table halves odd sizes by another rule, so only even ones are compared.
TEST(HeightSlope, PyramidIsTheMeanOfTwoByTwo) {
    for (const auto& [name, golden_pyramid] : golden_textures())
        for (std::size_t l = 1; l < golden_pyramid.levels.size(); ++l) {
            const Level<real>&fine = golden_pyramid.levels[l - 1], &want = golden_pyramid.levels[l];
            if ((fine.width > 1 && fine.width % 2) || (fine.height > 1 && fine.height % 2)) continue;
            const Level<real> got = half_size(fine, 1);
            ASSERT_EQ(got.width, want.width);
            ASSERT_EQ(got.height, want.height);
            for (std::size_t i = 0; i < got.texels.size(); ++i)
                EXPECT_NEAR(got.texels[i], want.texels[i], 1e-7L) << "texture " << name << ", level " << l;
        }
}

TEST(HeightSlope, OddSizesKeepTheMean) {
    const Pyramid<real> p = build_pyramid(Level<real>{5, 1, {1, 3, 5, 7, 100}}, 1);
    ASSERT_EQ(p.levels.size(), 3u);
    EXPECT_NEAR(p.levels[1].texels[0], (1 + 3 + 5 / 2.0L) / 2.5L, 1e-17L);
    EXPECT_NEAR(p.levels[1].texels[1], (5 / 2.0L + 7 + 100) / 2.5L, 1e-17L);
    EXPECT_NEAR(p.levels[2].texels[0], 116 / 5.0L, 1e-17L);
}

TEST(HeightSlope, OfARampIsItsSlopeAtEveryLevel) {
    Level<real> ramp{64, 32, {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) ramp.texels.push_back(3 * (x + 0.5L) / 64 - 2 * (y + 0.5L) / 32);
    const Pyramid<real> height = build_pyramid(ramp, 1);
    for (const real lod : {0.0L, 0.4L, 1.0L, 1.7L}) {
        for (const auto& slope : {plain_slope<real>, smooth_slope<real>}) {
            const Vec2<real> d = slope(height, {0.41L, 0.47L}, lod, Address::clamp);
            EXPECT_NEAR(d.x, 3, 1e-15L);
            EXPECT_NEAR(d.y, -2, 1e-15L);
        }
    }
}

TEST(HeightSlope, SmoothEqualsTheMatrixFormOfEquations20And21) {
    Level<real> level{4, 4, {}};
    for (int i = 0; i < 16; ++i) level.texels.push_back(std::sin(i * 1.7L));
    const real tx = 0.3L, ty = 0.8L;
    const real d[2][4] = {{-.5L, 0, .5L, 0}, {0, -.5L, 0, .5L}}, b[2][4] = {{.25L, .5L, .25L, 0}, {0, .25L, .5L, .25L}};
    Vec2<real> want;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) {
            const real q = level.texels[r * 4 + c];
            want.x += ((1 - ty) * b[0][r] + ty * b[1][r]) * q * ((1 - tx) * d[0][c] + tx * d[1][c]);
            want.y += ((1 - ty) * d[0][r] + ty * d[1][r]) * q * ((1 - tx) * b[0][c] + tx * b[1][c]);
        }
    const Vec2<real> got = smooth_slope_per_texel(level, {(1.5L + tx) / 4, (1.5L + ty) / 4}, Address::clamp);
    EXPECT_NEAR(got.x, want.x, 1e-18L);
    EXPECT_NEAR(got.y, want.y, 1e-18L);
}

}  // namespace
}  // namespace wrinkle::reference
