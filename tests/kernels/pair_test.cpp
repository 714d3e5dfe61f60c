// pair.clh
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

/// Expressions for what is left of a pair when a number of float's precision is subtracted: its low digits.
std::vector<std::string> rest(const std::string& pair, const std::string& known) {
    return {fmt::format("(({0}.high - {1}) + {0}.low)", pair, known)};
}

/// Of sums and products that need twice the digits of a float, a pair keeps all.
TEST(Pair, KeepsTwiceTheDigits) {
    cases::Cases c{.name = "pairs"};
    for (unsigned seed = 1; seed <= 400; ++seed) {
        cases::Random random(seed);
        const auto number = [&] { return random.uniform(0.5L, 2) * (random.below(2) ? 1 : -1); };
        const real a = number(), s = number(), b = number(), t = number();
        // The low part of a pair is at most half an ulp of its high part.
        const auto low = [&](real high) { return real{static_cast<float>(high * random.uniform(-5e-8L, 5e-8L))}; };
        const real al = low(a), sl = low(s), bl = low(b), tl = low(t);
        c.add("pairs, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("a", a), c.in("s", s), c.in("b", b), c.in("t", t);
        c.in("al", al), c.in("sl", sl), c.in("bl", bl), c.in("tl", tl);
        const real A = a + al, S = s + sl, B = b + bl, T = t + tl;
        const auto out = [&](const std::string& name, real value) {
            const real known = static_cast<float>(value);
            c.in(name + "_known", known), c.out(name, value - known);
        };
        out("product", A * S), out("quotient", A / S), out("fma", A * s + B), out("dop", A * S - B * T);
        out("sum", a + b + al);
    }
    check(c,
          "wr_pair pa = {a, al}, ps = {s, sl}, pb = {b, bl}, pt = {t, tl};\n"
          "wr_pair product = wr_multiply(pa, ps), quotient = wr_divide(pa, ps), sum = wr_pair_sum(a, b, al);\n"
          "wr_pair along = wr_fma(pa, s, pb), difference = wr_dop(pa, ps, pb, pt);",
          {{"product", rest("product", "product_known"), ErrorMeasure::absolute, 2e-13, 2e-13, 1e-13},
           {"quotient", rest("quotient", "quotient_known"), ErrorMeasure::absolute, 2e-13, 2e-13, 1e-13},
           {"fma", rest("along", "fma_known"), ErrorMeasure::absolute, 2e-13, 2e-13, 1e-13},
           {"dop", rest("difference", "dop_known"), ErrorMeasure::absolute, 4e-13, 4e-13, 1e-13},
           {"sum", rest("sum", "sum_known"), ErrorMeasure::absolute, 2e-14, 2e-14, 1e-13}});
}

TEST(Pair, DotProductsThatCancel) {
    cases::Cases c{.name = "dot products with pairs"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        cases::Random random(seed);
        const V a = random.unit(), low = random.box(5e-8L);
        V b = random.box(1);
        if (seed % 2 == 0) b = cases::Random::rounded(cross(a, b));  // nearly perpendicular
        c.add("dot products with pairs, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("a", a), c.in("b", b), c.in("low", low);
        c.out("dot", dot(a, b + low));
    }
    check(c,
          "wr_pair3 p = {{b.x, low.x}, {b.y, low.y}, {b.z, low.z}};\n"
          "wr_real d = wr_dot2(a, p);",
          {{"dot", {"d"}, ErrorMeasure::absolute, 1.3e-7, 2e-14}});
}

/// A constant that the host has split in two becomes one number in a double program.
TEST(Pair, ConstantsOfTheHost) {
    const double third = 1.0 / 3, high = static_cast<float>(third);
    ColumnData data;
    data.constants = {high, third - high};
    data.constants_per_row = 0;
    const Columns columns{{"one", {1, 1, 1}}};
    for (const int lanes : lanes_to_try()) {
        const Results r = run_kernel({"wr_pair p = wr_constant_pair(constants[0], constants[1]);", {"p.high", "p.low"}},
                                     columns, {lanes, false}, data);
        EXPECT_NEAR(r[0][1] + r[1][1], third, 1e-15);
        EXPECT_EQ(r[0][1], high);
    }
}

}  // namespace
}  // namespace wrinkle::test
