// shade/lighting.clh
#include "tests/cases/lighting.h"

#include "tests/kernels/check.h"
#include "tests/reference/relit.h"

namespace wrinkle::test {
namespace {

const std::string light_it =
    "constant const wr_lighting *lighting = (constant const wr_lighting *)constants;\n"
    "constant const wr_light *lights = (constant const wr_light *)(lighting + 1);\n"
    "wr_vec3 albedo = wr_v3((wr_real)(0.5f), (wr_real)(0.25f), (wr_real)(0.75f));\n"
    "wr_vec3 lit = wr_light_surface(p, unit(n), unit(m), unit(v), albedo, roughness, lighting, lights);";

TEST(Lighting, RadianceOfThreeLights) {
    check(cases::lighting_cases(), light_it,
          {{"lit", xyz("lit"), ErrorMeasure::relative, cases::lighting_relative, cases::smooth_lighting_relative,
            1e-11}});
}

TEST(Lighting, WhatOnePictureShowsOfTheLights) {
    // What is specular alone has no diffuse beside it that its rounding would be small against.
    const auto answer = [](const std::string& want, const std::string& vector, double bound = 2e-6) {
        return Answer{want, xyz(vector), ErrorMeasure::relative, bound, 1e-3, 1e-10};
    };
    check(cases::lighting_cases(),
          light_it +
              "wr_vec3 lamp = wr_light_group(1, p, unit(n), unit(m), unit(v), albedo, roughness, lighting, lights);\n"
              "wr_vec3 base = wr_light_group(1, p, unit(m), unit(m), unit(v), albedo, roughness, lighting, lights);\n"
              "wr_vec3 gleam = wr_light_group(2, p, unit(n), unit(m), unit(v), albedo, roughness, lighting, lights);\n"
              "wr_vec3 rest = wr_light_group(0, p, unit(n), unit(m), unit(v), albedo, roughness, lighting, lights);\n"
              "wr_vec3 sky = wr_sky(lighting, unit(n), unit(m));",
          {answer("lamp", "lamp"), answer("base", "base"), answer("gleam", "gleam", 6e-6), answer("rest", "rest", 6e-6),
           answer("sky", "sky")});
}

TEST(Lighting, FadesToNothingAtTheRange) {
    cases::Cases c{.name = "range window"};
    for (const real distance : {0.0L, 1e-20L, 0.01L, 0.3L, 0.7L, 0.9L, 0.99L, 0.9999L, 1.0L, 1.0001L, 2.0L, 1e18L}) {
        c.add(fmt::format("at {} of the range", double(distance)), distance > 1e10L);
        const real square = static_cast<float>(distance * distance);
        c.in("square", square), c.out("keeps", reference::range_window(1.0, std::sqrt(square)));
    }
    check(c, "wr_real keeps = wr_range_window(square);", {{"keeps", {"keeps"}, ErrorMeasure::absolute, 5e-7, 5e-7}});
}

TEST(Lighting, IsFiniteAtALightAndOppositeToTheView) {
    const float z = 1, far = 1e20f, near = 1e-20f;
    const Columns columns{{"p.x", {2, 2 + 1e-6f, far, near, 2}},
                          {"p.y", {-1, -1, far, near, -1}},
                          {"p.z", {3, 3, far, near, 3}},
                          {"n.x", {0, 0, 0, 0, 1}},
                          {"n.y", {0, 0, 0, 0, 0}},
                          {"n.z", {z, -z, z, z, 0}},
                          {"m.x", {0, 0, 0, 0, 1}},
                          {"m.y", {0, 0, 0, 0, 0}},
                          {"m.z", {z, -z, z, -z, 0}},
                          {"v.x", {0, 0, 0, 0, 0}},
                          {"v.y", {0, 0, 0, 0, 0}},
                          {"v.z", {z, -z, z, -z, -z}},
                          {"roughness", {0, 0, 1, 0, 0}}};
    const ColumnData data = cases::lighting_cases().data;
    for (const int lanes : lanes_to_try()) {
        const Results r = run_kernel({light_it, xyz("lit")}, columns, {lanes, false}, data);
        for (const auto& channel : r)
            for (std::size_t i = 0; i < channel.size(); ++i)
                EXPECT_TRUE(std::isfinite(channel[i])) << "row " << i << ", " << lanes << " lanes";
    }
}

TEST(Lighting, NothingIsLitBehindTheSurfaceThatCarriesTheBumps) {
    check(cases::terminator_cases(),
          "wr_vec3 bumped = unit(n), base = unit(m), l = unit(p);\n"
          "wr_real n_l = fmax(wr_dot(bumped, l), (wr_real)(0));\n"
          "wr_real keeps = wr_terminator(wr_dot(base, l), n_l, wr_dot(bumped, base));",
          {{"keeps", {"keeps"}, ErrorMeasure::absolute, 2e-6, 1e-4, 1e-10}});
}

TEST(Lighting, NothingIsMirroredFromBelowTheSurface) {
    check(cases::mirror_cases(), "wr_vec3 mirror = wr_mirror_normal(unit(n), unit(m), unit(v));",
          {{"mirror", xyz("mirror"), ErrorMeasure::degrees, 1e-4, 2e-2, 1e-8}});
}

TEST(Lighting, RoughnessWidensByTwiceTheVariance) {
    cases::Cases c{.name = "widened roughness"};
    for (const real roughness : {0.0L, 0.03L, 0.3L, 1.0L})
        for (const real xx : {0.0L, 1e-12L, 0.01L, 0.5L, 100.0L}) {
            c.add(fmt::format("roughness {}, variance {}", double(roughness), double(xx)), true);
            c.in("roughness", roughness), c.in("spread", V{xx, 0.1L * xx, 2 * xx});
            const real r = static_cast<float>(roughness), x = static_cast<float>(xx), z = static_cast<float>(2 * xx);
            c.out("wide", std::min(std::pow(r * r * r * r + x + z, 0.25L), real{1}));
        }
    check(c, "wr_real wide = wr_widened_roughness(roughness, spread);",
          {{"wide", {"wide"}, ErrorMeasure::absolute, 1e-6, 1e-6}});
}

TEST(Lighting, RatioIsBounded) {
    cases::Cases c{.name = "relight ratio"};
    for (const real now : {0.0L, 1e-6L, 0.1L, 1.0L, 1e4L, 3e38L})
        for (const real old : {0.0L, 1e-6L, 0.3L, 1.0L, 1e4L, 3e38L}) {
            c.add(fmt::format("ratio of {} and {}", double(now), double(old)), true);
            c.in("now", now), c.in("old", old);
            c.out("ratio", reference::relight_ratio<real>(static_cast<float>(now), static_cast<float>(old), 4));
        }
    c.data.constants = {4};
    check(c, "wr_real ratio = wr_relight_ratio(now, old, constants[0]);",
          {{"ratio", {"ratio"}, ErrorMeasure::relative, 0, 5e-7}});
}

/// Pictures of some of three lights and of others, over a sky; huge, tiny and black ones, and lights beside some that
/// give nothing.
TEST(Relight, LightsAreToldApartByTheirColours) {
    cases::Cases c{.name = "visibilities"};
    for (unsigned seed = 1; seed <= 120; ++seed) {
        cases::Random random(seed);
        const bool hard = seed > 80;
        const real size = hard ? std::pow(real{10}, random.uniform(-12, 12)) : real{1};
        const auto colour = [&](real most) {
            return cases::Random::rounded(V{random.uniform(0, most), random.uniform(0, most), random.uniform(0, most)} *
                                          size);
        };
        std::vector<V> lit{colour(1), colour(1), colour(1)};
        if (seed % 10 == 9) lit[seed % 3] = {};
        if (seed % 40 == 0) lit[0] = lit[1] = {};
        const V sky = seed % 7 == 0 ? V{} : colour(0.3L);
        V picture = seed % 5 == 0 ? colour(1) : sky;
        for (unsigned k = 0; k < 3; ++k)
            if (seed >> k & 1) picture = picture + lit[k];
        if (seed % 11 == 0) picture = {};
        picture = cases::Random::rounded(picture);
        const real least = seed % 2 ? 0 : 0.5L;
        c.add(fmt::format("visibilities, seed {}", seed), hard);
        c.in("picture", picture), c.in("sky", sky), c.in("least", least);
        c.in("a", lit[0]), c.in("b", lit[1]), c.in("c", lit[2]);
        const auto [reached, all] = reference::visibilities<real>(picture, sky, lit, least);
        c.out("first", reached[0]), c.out("second", reached[1]), c.out("third", reached[2]), c.out("all", all);
    }
    const auto answer = [](const std::string& want, const std::string& got) {
        return Answer{want, {got}, ErrorMeasure::absolute, 2e-4, 2e-4, 1e-9};
    };
    check(c,
          "const wr_vec3 lit[3] = {a, b, c};\nwr_real reached[3];\n"
          "wr_real all = wr_visibilities(picture, sky, lit, 3, WR_R(0.5), reached);\n"
          "wr_real with_least[3] = {reached[0], reached[1], reached[2]};\n"
          "wr_real whole = wr_visibilities(picture, sky, lit, 3, 0, reached);\n"
          "wr_mask some = least > 0;\n"
          "all = some ? all : whole;\n"
          "wr_real first = some ? with_least[0] : reached[0], second = some ? with_least[1] : reached[1],\n"
          "        third = some ? with_least[2] : reached[2];",
          {answer("first", "first"), answer("second", "second"), answer("third", "third"), answer("all", "all")});
}

}  // namespace
}  // namespace wrinkle::test
