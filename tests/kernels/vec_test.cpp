// vec.clh
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

/// Sums of products that cancel to nearly nothing. The truth is computed in long double, which holds products of floats
/// exactly.
TEST(Vec, CompensatedFormsKeepTheirDigitsWhereTermsCancel) {
    cases::Cases c{.name = "compensated forms"};
    for (unsigned seed = 1; seed <= 400; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 2 == 0;
        const V a = random.box(1);
        const real nearly = random.magnitude(-7, -1);
        V b = random.box(1);
        if (hard) b = cases::Random::rounded(a * random.uniform(1, 2) + b * nearly);
        V n = random.box(1);
        if (hard) n = cases::Random::rounded(a * random.uniform(-1, 1) + b * random.uniform(-1, 1) + n * nearly);
        V o = random.box(1);
        if (hard) o = cases::Random::rounded(cross(a, o) + a * nearly);
        c.add("compensated forms, seed " + std::to_string(seed), hard);
        c.in("a", a), c.in("b", b), c.in("n", n), c.in("o", o);
        c.out("dop", a.x * b.y - a.y * b.x);
        c.out("cross", cross(a, b));
        c.out("dot2", dot(a, o));
        c.out("triple", dot(n, cross(a, b)));
    }
    check(c, "wr_vec3 axb = wr_cross(a, b);",
          {{"dop", {"wr_dop(a.x, b.y, a.y, b.x)"}, ErrorMeasure::relative, 1.2e-7, 1.2e-7},
           {"cross", xyz("axb"), ErrorMeasure::relative, 1.2e-7, 1.2e-7},
           {"dot2", {"wr_dot2(a, o)"}, ErrorMeasure::relative, 1.2e-7, 1.2e-7}});
    // Compensation doubles the digits. Where more of them cancel than that, a larger error is allowed.
    for (std::size_t row = 0; row < c.size(); ++row) {
        const real terms = length(c.vec(row, "n")) * length(c.vec(row, "a")) * length(c.vec(row, "b"));
        c.allowance[row] = std::max(real{1}, 1e-7L * terms / std::abs(c.want["triple"][row].x));
    }
    check(c, "", {{"triple", {"wr_triple(n, a, b)"}, ErrorMeasure::relative, 1.2e-7, 1.2e-7}});
}

TEST(Vec, NormalizeOfAnyLength) {
    cases::Cases c{.name = "normalize"};
    const auto add = [&](const std::string& label, V v) {
        v = cases::Random::rounded(v);
        c.add(label, true);
        c.in("v", v);
        c.out("unit", normalize(v));
    };
    for (unsigned seed = 1; seed <= 300; ++seed) {
        cases::Random random(seed);
        const V skew{1, random.magnitude(-20, 0), random.magnitude(-40, 0)};
        const V u = random.unit();
        add("normalize, seed " + std::to_string(seed),
            V{u.x * skew.x, u.y * skew.y, u.z * skew.z} * random.magnitude(-44, 38));
    }
    const real largest = std::numeric_limits<float>::max();
    add("normalize the largest", V{largest, -largest, largest});
    add("normalize the smallest", V{0, 1e-45L, 0});
    add("normalize zero", V{});
    check(c, "wr_vec3 r = wr_normalize(v); wr_real p = wr_prescale(wr_largest(v)) * wr_largest(v);",
          {{"unit", xyz("r"), ErrorMeasure::absolute, 0, 2.4e-7}, {"unit", xyz("r"), ErrorMeasure::degrees, 0, 1e-5}});
}

/// Normals as G-buffers store them. Short, long and broken ones do not change the results of other lanes.
TEST(Vec, RenormalizeOfNearlyUnitVectors) {
    cases::Cases c{.name = "renormalize"};
    for (unsigned seed = 1; seed <= 600; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 3 == 0;
        const real size = hard ? random.magnitude(-30, 30) : 1 + random.uniform(-0.0085L, 0.0085L);
        const V v = cases::Random::rounded(random.unit() * size);
        c.add("renormalize, seed " + std::to_string(seed), hard);
        c.in("v", v), c.out("unit", normalize(v));
    }
    check(c, "wr_vec3 r = wr_renormalize(v);",
          {{"unit", xyz("r"), ErrorMeasure::absolute, 1.2e-7, 2.4e-7},
           {"unit", xyz("r"), ErrorMeasure::degrees, 4e-6, 1e-5}});
    Columns columns;
    for (const char axis : {'x', 'y', 'z'})
        for (std::size_t i = 0; i < c.size(); ++i)
            columns[std::string("v.") + axis].push_back(c.inputs.at(std::string("v.") + axis)[i]);
    const Results alone = run_kernel({"wr_vec3 r = wr_renormalize(v);", xyz("r")}, columns, {1, false});
    EXPECT_EQ(run_kernel({"wr_vec3 r = wr_renormalize(v);", xyz("r")}, columns, {16, false}), alone);
}

TEST(Vec, NonzeroWhereAComponentIs) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Columns columns{
        {"v.x", {0, -0.0f, 1e-30f, 0, 0, nan}}, {"v.y", {0, 0, 0, -2, 0, 0}}, {"v.z", {0, -0.0f, 0, 0, 3, 0}}};
    const Results r =
        run_kernel({"wr_real r = wr_nonzero(v) ? (wr_real)(1) : (wr_real)(0);", {"r"}}, columns, {8, false});
    EXPECT_EQ(r[0], (std::vector<double>{0, 0, 1, 1, 1, 1}));
}

TEST(Vec, PrescaleIsAPowerOfTwoThatBringsSizesNearOne) {
    Columns columns;
    for (int e = -126; e < 127; ++e)
        for (const float m : {1.0f, 1.5f, 1.9999999f}) columns["size"].push_back(std::ldexp(m, e));
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r =
                run_kernel({"", {"wr_prescale(size)", "size * wr_prescale(size)"}}, columns, {lanes, fp64});
            for (std::size_t i = 0; i < r[0].size(); ++i) {
                int exponent;
                EXPECT_EQ(std::frexp(r[0][i], &exponent), 0.5);
                EXPECT_GE(r[1][i], 1) << columns["size"][i];
                EXPECT_LT(r[1][i], 2) << columns["size"][i];
            }
        }
    const Results zero = run_kernel({"", {"wr_prescale(size)"}}, {{"size", {0, 1e-45f, 3.4e38f}}}, {8, false});
    for (const double power : zero[0]) EXPECT_TRUE(std::isfinite(power) && power > 0);
}

TEST(Vec, SoundTellsFiniteVectors) {
    const float inf = INFINITY, nan = NAN;
    const Columns columns{{"v.x", {0, 1e38f, inf, 0, 0, nan, 0, 3.4e38f}},
                          {"v.y", {0, -1e38f, 0, -inf, 0, 0, nan, 3.4e38f}},
                          {"v.z", {0, 1e-45f, 0, 0, inf, 0, 0, 3.4e38f}}};
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try())
            EXPECT_EQ(run_kernel({"", {"truth(wr_sound(v))"}}, columns, {lanes, fp64})[0],
                      (std::vector<double>{1, 1, 0, 0, 0, 0, 0, 1}));
}

TEST(Vec, RampIsClamped) {
    const Columns columns{{"v", {-5, 0, 1, 1.5f, 2, 2.5f, 3, 99}}};
    for (const int lanes : lanes_to_try())
        EXPECT_EQ(run_kernel({"", {"wr_ramp(v, (wr_real)(1), (wr_real)(3))"}}, columns, {lanes, false})[0],
                  (std::vector<double>{0, 0, 0, 0.25, 0.5, 0.75, 1, 1}));
}

}  // namespace
}  // namespace wrinkle::test
