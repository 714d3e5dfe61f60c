// sources/dual.clh: gradients against central differences, in long double, of the same values by the C++ library.
#include "tests/cases/noise.h"
#include "tests/kernels/check.h"
#include "tests/reference/noise.h"

namespace wrinkle::test {
namespace {

using Height = std::function<real(real x, real y, real z)>;

/// Random points, and the value and gradient there.
Cases points_of(const char* name, const Height& height, real low, real high) {
    constexpr real step = 1e-6L;
    Cases c{.name = name};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        cases::Random random(seed);
        const V p{static_cast<float>(random.uniform(low, high)), static_cast<float>(random.uniform(low, high)),
                  static_cast<float>(random.uniform(low, high))};
        c.add(fmt::format("{}, seed {}", name, seed), true);
        c.in("p", p);
        c.out("value", height(p.x, p.y, p.z));
        c.out("gradient", V{(height(p.x + step, p.y, p.z) - height(p.x - step, p.y, p.z)) / (2 * step),
                            (height(p.x, p.y + step, p.z) - height(p.x, p.y - step, p.z)) / (2 * step),
                            (height(p.x, p.y, p.z + step) - height(p.x, p.y, p.z - step)) / (2 * step)});
    }
    return c;
}

struct Formula {
    const char* text;  ///< of the kernel, in x, y and z
    Height height;
    real low = -2, high = 2;
    double bound = 2e-6, fp64 = 1e-9;  ///< absolute; the differences are good to 1e-10
};

class Duals : public testing::TestWithParam<int> {};

const Formula formulas[] = {
    {"wr_add(wr_mul(x, y), wr_mul(z, (wr_real)(3)))", [](real x, real y, real z) { return x * y + 3 * z; }},
    {"wr_sub(wr_add(x, (wr_real)(2)), wr_mul(wr_negative(y), wr_sub(z, (wr_real)(1))))",
     [](real x, real y, real z) { return x + 2 + y * (z - 1); }},
    {"wr_div(x, wr_add(wr_mul(y, y), (wr_real)(1)))", [](real x, real y, real) { return x / (y * y + 1); }},
    {"wr_div(wr_add(x, z), (wr_real)(4))", [](real x, real, real z) { return (x + z) / 4; }},
    {"wr_sqrt(wr_add(wr_mul(x, x), (wr_real)(1)))", [](real x, real, real) { return std::sqrt(x * x + 1); }},
    {"wr_mul(wr_sin(wr_mul(x, (wr_real)(2))), wr_cos(y))",
     [](real x, real y, real) { return std::sin(2 * x) * std::cos(y); }},
    {"wr_exp(wr_mul(x, y))", [](real x, real y, real) { return std::exp(x * y); }, -1, 1},
    {"wr_log(wr_add(wr_mul(x, x), (wr_real)(1)))", [](real x, real, real) { return std::log(x * x + 1); }},
    {"wr_pow(x, (wr_real)(2.5f))", [](real x, real, real) { return std::pow(x, 2.5L); }, 0.1L, 2},
    {"wr_max(wr_min(x, y), z)", [](real x, real y, real z) { return std::max(std::min(x, y), z); }},
    {"wr_abs(wr_mul(x, y))", [](real x, real y, real) { return std::abs(x * y); }},
    {"wr_limit(wr_mul(x, y), (wr_real)(-0.5f), (wr_real)(0.5f))",
     [](real x, real y, real) { return std::clamp(x * y, -0.5L, 0.5L); }},
    {"wr_fraction(wr_mul(x, (wr_real)(3)))", [](real x, real, real) { return 3 * x - std::floor(3 * x); }},
    {"wr_smoothstep((wr_real)(-1), (wr_real)(1), x)",
     [](real x, real, real) {
         const real t = std::clamp((x + 1) / 2, 0.0L, 1.0L);
         return t * t * (3 - 2 * t);
     }},
    {"wr_mix(x, y, z)", [](real x, real y, real z) { return x + (y - x) * z; }},
    {"wr_length(x, y, z)", [](real x, real y, real z) { return std::sqrt(x * x + y * y + z * z); }},
    {"wr_noise_of(wr_mul(x, (wr_real)(2)), wr_add(y, z), wr_mul(z, z))",
     [](real x, real y, real z) {
         return reference::perlin_noise(V{2 * x, y + z, z * z}).value;
     },
     -2, 2, 1e-5},
};

TEST_P(Duals, HaveTheGradientsOfTheirValues) {
    const Formula& formula = formulas[GetParam()];
    check(points_of(formula.text, formula.height, formula.low, formula.high),
          fmt::format("wr_dual x = wr_dual_x(p), y = wr_dual_y(p), z = wr_dual_z(p);\nwr_dual f = {};", formula.text),
          {{"value", {"f.value"}, ErrorMeasure::absolute, formula.bound, formula.bound, formula.fp64},
           {"gradient", xyz("f.gradient"), ErrorMeasure::absolute, formula.bound, formula.bound, formula.fp64}});
}
INSTANTIATE_TEST_SUITE_P(Formulas, Duals, testing::Range(0, static_cast<int>(std::size(formulas))));

/// Where a function has no finite derivative, or no value, duals are flat; nothing is NaN or infinite.
TEST(Duals, AreFiniteWhereDerivativesAreNot) {
    Cases c{.name = "edges"};
    c.add("zero", true);
    c.in("p", V{0, 0, 0});
    c.out("value", real{0}), c.out("gradient", V{0, 0, 0});
    for (const char* text : {"wr_sqrt(x)", "wr_div(x, y)", "wr_pow(x, (wr_real)(0.5f))", "wr_length(x, y, z)",
                             "wr_abs(x)", "wr_sub(wr_log(x), wr_log(x))", "wr_sqrt(wr_sub(x, (wr_real)(1)))"})
        check(c, fmt::format("wr_dual x = wr_dual_x(p), y = wr_dual_y(p), z = wr_dual_z(p);\nwr_dual f = {};", text),
              {{"value", {"f.value"}, ErrorMeasure::absolute, 0, 0},
               {"gradient", xyz("f.gradient"), ErrorMeasure::absolute, 0, 0}});
}

TEST(RandomOfCell, IsUniformAndOfAnotherSaltAnotherNumber) {
    Cases c{.name = "cells"};
    for (int i = 0; i < 4000; ++i) {
        c.add(fmt::format("cell {}", i), true);
        c.in("p", V{real(i % 63 - 31), real(i / 63 - 31), real(i % 7)});
    }
    ColumnKernel kernel{"", {"wr_random_of_cell(p, 1)", "wr_random_of_cell(p, 2)"}};
    const Results got = run_kernel(kernel, c.inputs, {8, false});
    EXPECT_EQ(got, run_kernel(kernel, c.inputs, {1, true}));
    double mean = 0, square = 0, product = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
        ASSERT_TRUE(got[0][i] >= 0 && got[0][i] < 1);
        mean += got[0][i] / 4000, square += got[0][i] * got[0][i] / 4000;
        product += (got[0][i] - 0.5) * (got[1][i] - 0.5) / 4000;
    }
    EXPECT_NEAR(mean, 0.5, 0.02);
    EXPECT_NEAR(square, 1.0 / 3, 0.02);
    EXPECT_NEAR(product, 0, 0.01);
}

}  // namespace
}  // namespace wrinkle::test
