// sources/texture.clh
#include "tests/cases/height_map.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

/// A picture of odd size that repeats, as textures of one, two and three channels.
struct Picture {
    cases::Pyramid pyramid;
    cases::Cases cases{.name = "texture samples"};

    Picture() {
        cases::Random random(3);
        reference::Level<real> top{21, 11, {}};
        for (int i = 0; i < 4 * 21 * 11; ++i) top.texels.push_back(random.uniform(-1, 1));
        pyramid = reference::build_pyramid(top, 4);
        const auto texel = [](const auto& level, int c, int x, int y) {
            return level.at(c, x, y, cases::Address::repeat);
        };
        cases::add_texture(this->cases.data, pyramid, 1, texel);
        cases::add_texture(this->cases.data, pyramid, 2, texel);
        cases::add_texture(this->cases.data, pyramid, 4, texel);  // a texel of three channels is stored in four floats
    }
};

TEST(Texture, SamplesAreTrilinear) {
    Picture picture;
    cases::Cases& c = picture.cases;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        cases::Random random(seed);
        const V2 st = seed % 4 == 0 ? V2{real(random.below(22)) / 21, real(random.below(12)) / 11}
                                    : V2{random.uniform(-3, 3), random.uniform(-3, 3)};
        const V2 at{static_cast<float>(st.x), static_cast<float>(st.y)};
        const real lod = seed % 3 == 0 ? real(random.below(5)) : random.uniform(0, 4);
        c.add("texture sample, seed " + std::to_string(seed), seed % 4 == 0);
        c.in("st", at), c.in("lod", lod);
        const auto channel = [&](int k) { return sample(picture.pyramid, k, at, lod, cases::Address::repeat); };
        c.out("one", channel(0)), c.out("two", V2{channel(0), channel(1)});
        c.out("three", V{channel(0), channel(1), channel(2)});
    }
    check(c,
          "wr_real s = wr_repeat(st.x), v = wr_repeat(st.y);\n"
          "wr_real one = wr_texture_sample1(wr_texture_at(texels, textures, 0), s, v, lod);\n"
          "wr_vec2 two = wr_texture_sample2(wr_texture_at(texels, textures, 1), s, v, lod);\n"
          "wr_vec3 three = wr_texture_sample3(wr_texture_at(texels, textures, 2), s, v, lod);",
          {{"one", {"one"}, ErrorMeasure::absolute, 1e-5, 1e-5, 1e-7},
           {"two", xy("two"), ErrorMeasure::absolute, 1e-5, 1e-5, 1e-7},
           {"three", xyz("three"), ErrorMeasure::absolute, 1e-5, 1e-5, 1e-7}});
}

TEST(Texture, LostSlopesAreThoseOfTexelsAndOfBlendsOfLevels) {
    Picture picture;
    cases::Cases& c = picture.cases;
    const int last = static_cast<int>(picture.pyramid.levels.size()) - 1;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        cases::Random random(seed);
        const bool beyond = seed % 5 == 0;
        const real lod = beyond          ? random.uniform(last, 40)
                         : seed % 2 == 0 ? random.below(last + 1)
                                         : random.uniform(0, last);
        const int fine = std::min(static_cast<int>(lod), last), coarse = std::min(fine + 1, last);
        const real weight = beyond ? 0 : lod - fine;
        // Anywhere but at the rims of texels, where rounding chooses.
        V2 at;
        const auto rim = [&](int level, real s, int size) {
            const real x = s * (size >> level == 0 ? 1 : size >> level);
            return std::abs(x - std::round(x)) < 1e-3L;
        };
        do at = {static_cast<float>(random.uniform(0, 1)), static_cast<float>(random.uniform(0, 1))};
        while (rim(fine, at.x, 21) || rim(fine, at.y, 11) || rim(coarse, at.x, 21) || rim(coarse, at.y, 11));
        c.add("lost slopes, seed " + std::to_string(seed), beyond);
        c.in("st", at), c.in("lod", lod);
        const auto texel = [&](int level, int k) {
            const reference::Level<real>& texels = picture.pyramid.levels[static_cast<std::size_t>(level)];
            return texels.at(k, static_cast<int>(at.x * texels.width), static_cast<int>(at.y * texels.height),
                             cases::Address::repeat);
        };
        // The variance of a blend of two levels, whose difference has the variance that the coarser one lost.
        const auto lost = [&](int k) {
            const real between = texel(coarse, k) - texel(fine, k);
            return texel(fine, k) * (1 - weight) + texel(coarse, k) * weight + weight * (1 - weight) * between;
        };
        c.out("lost", V{lost(0), lost(1), lost(2)});
    }
    check(c, "wr_vec3 lost = wr_lost_slopes(wr_texture_at(texels, textures, 2), st.x, st.y, lod);",
          {{"lost", xyz("lost"), ErrorMeasure::absolute, 5e-6, 5e-6, 1e-6}});
}

TEST(Texture, LevelsLieWithinThePyramidForAnyDerivative) {
    Picture picture;
    cases::Cases& c = picture.cases;
    const real values[] = {0, 1e-45L, 1e-20L, 1.0L / 64, 1, 7, 1e10L, 1e20L, 3e38L};
    for (const real a : values)
        for (const real b : values) {
            c.add(fmt::format("lod of {:.3g}, {:.3g}", double(a), double(b)), true);
            c.in("dx", V2{a, 0}), c.in("dy", V2{0, -b});
            const real fa = static_cast<float>(a), fb = static_cast<float>(b);
            c.out("lod", reference::level_of_detail<real>({{fa, 0}, {0, -fb}}, 21, 11, 5));
        }
    check(c,
          "wr_texture t = wr_texture_at(texels, textures, 0);\n"
          "wr_levels l = wr_texture_levels(t, wr_texture_lod(t, dx, dy));",
          {{"lod", {"wr_to_real(l.fine) + l.weight"}, ErrorMeasure::absolute, 2e-6, 2e-6}});
}

/// A level outside would read foreign memory.
TEST(Texture, LevelsLieWithinThePyramidForAnyLod) {
    Picture picture;
    cases::Cases& c = picture.cases;
    const real infinite = std::numeric_limits<real>::infinity(), nan = std::numeric_limits<real>::quiet_NaN();
    const std::pair<real, V2> rows[] = {{nan, {0, 1}},   {-infinite, {0, 1}}, {-1e-20L, {0, 1}}, {0, {0, 1}},
                                        {0.5L, {0, 1}},  {1, {1, 2}},         {3.75L, {3, 4}},   {4, {4, 4}},
                                        {4.25L, {4, 4}}, {3e38L, {4, 4}},     {infinite, {4, 4}}};
    for (const auto& [lod, levels] : rows) {
        c.add(fmt::format("levels of {:.3g}", double(lod)), true);
        c.in("lod", lod), c.out("levels", levels);
    }
    check(c, "wr_levels l = wr_texture_levels(wr_texture_at(texels, textures, 0), lod);",
          {{"levels", {"wr_to_real(l.fine)", "wr_to_real(l.coarse)"}, ErrorMeasure::absolute, 0, 0}});
}

/// Coordinates stay within the texture, whatever they are: an index outside would read foreign memory.
TEST(Texture, CoordinatesStayInsideForAnyNumber) {
    const Columns columns{
        {"s", {-0.0f, -1e-45f, -1e-10f, 0.25f, 1.0f, -1.0f, 1e5f, -3.4e38f, 3.4e38f, INFINITY, -INFINITY, NAN}}};
    for (const int lanes : lanes_to_try()) {
        const Results r = run_kernel({"", {"wr_repeat(s)", "wr_clamp(s)"}}, columns, {lanes, false});
        for (std::size_t i = 0; i < r[0].size(); ++i)
            for (const auto& column : r)
                EXPECT_TRUE(column[i] >= 0 && column[i] <= 1)
                    << lanes << " lanes, s = " << columns.at("s")[i] << ": " << column[i];
    }
}

}  // namespace
}  // namespace wrinkle::test
