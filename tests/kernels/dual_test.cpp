// dual.clh, dual_noise.clh: values against the same formulas in long double, gradients against central differences of
// those.
#include "tests/kernels/check.h"
#include "tests/reference/noise.h"

namespace wrinkle::test {
namespace {

struct Formula {
    const char* text;  ///< of a wr_dual of the point p
    std::function<real(V)> value;
    double error = 2e-6, fp64 = 1e-12;  ///< of value and gradient, absolute
};

V central_differences(const std::function<real(V)>& f, V p) {
    const real h = 1e-7L;
    return {(f({p.x + h, p.y, p.z}) - f({p.x - h, p.y, p.z})) / (2 * h),
            (f({p.x, p.y + h, p.z}) - f({p.x, p.y - h, p.z})) / (2 * h),
            (f({p.x, p.y, p.z + h}) - f({p.x, p.y, p.z - h})) / (2 * h)};
}

/// Every formula at random points of the box from 0.25 to 2.25.
void check_formulas(const std::string& name, const std::vector<Formula>& formulas) {
    cases::Cases c{.name = name};
    std::string body = "wr_point p = wr_point_of(v);\n";
    std::vector<Answer> answers;
    for (std::size_t k = 0; k < formulas.size(); ++k) {
        body += fmt::format("wr_dual f{} = {};\n", k, formulas[k].text);
        const std::string value = fmt::format("value of {}", formulas[k].text),
                          gradient = fmt::format("gradient of {}", formulas[k].text), f = fmt::format("f{}", k);
        answers.push_back(
            {value, {f + ".value"}, ErrorMeasure::absolute, formulas[k].error, formulas[k].error, formulas[k].fp64});
        answers.push_back({gradient, xyz(f + ".gradient"), ErrorMeasure::absolute, formulas[k].error, formulas[k].error,
                           std::max(formulas[k].fp64, 1e-10)});
    }
    for (unsigned seed = 1; seed <= 100; ++seed) {
        cases::Random random(seed);
        const V p{random.uniform(0.25L, 2.25L), random.uniform(0.25L, 2.25L), random.uniform(0.25L, 2.25L)};
        c.add(fmt::format("{}, seed {}", name, seed), false);
        c.in("v", p);
        for (std::size_t k = 0; k < formulas.size(); ++k) {
            c.out(answers[2 * k].name, formulas[k].value(p));
            c.out(answers[2 * k + 1].name, central_differences(formulas[k].value, p));
        }
    }
    check(c, body, answers);
}

TEST(Dual, Arithmetic) {
    check_formulas(
        "dual arithmetic",
        {{"wr_add(p.x, wr_add(p.y, 3))", [](V p) { return p.x + p.y + 3; }},
         {"wr_sub(1, wr_sub(p.x, wr_sub(p.y, 2)))", [](V p) { return 1 - (p.x - (p.y - 2)); }},
         {"wr_multiply(wr_multiply(p.x, p.y), wr_multiply(0.5f, p.z))", [](V p) { return p.x * p.y * p.z / 2; }},
         {"wr_divide(wr_multiply(p.x, p.z), p.y)", [](V p) { return p.x * p.z / p.y; }, 2e-5},
         {"wr_divide(wr_divide(1, p.z), 4)", [](V p) { return 1 / p.z / 4; }},
         {"wr_mix(p.x, wr_multiply(p.y, p.y), p.z)", [](V p) { return p.x + (p.y * p.y - p.x) * p.z; }},
         {"wr_dot(p, wr_add(p, p))", [](V p) { return 2 * dot(p, p); }, 4e-6},
         {"wr_length(wr_sub(p, wr_v3((wr_real)(3), (wr_real)(0), (wr_real)(0))))",
          [](V p) {
              return length(p - V{3, 0, 0});
          }},
         {"wr_dot(wr_scale(p, (wr_real)(2)), wr_v3((wr_real)(1), (wr_real)(2), (wr_real)(-1)))",
          [](V p) { return 2 * (p.x + 2 * p.y - p.z); }, 4e-6}});
}

TEST(Dual, FunctionsOfOneNumber) {
    check_formulas(
        "dual functions",
        {{"wr_sqrt(wr_multiply(p.x, p.y))", [](V p) { return std::sqrt(p.x * p.y); }},
         {"wr_sin(wr_multiply(p.x, wr_multiply(p.y, 3)))", [](V p) { return std::sin(3 * p.x * p.y); }, 1e-5},
         {"wr_cos(wr_multiply(p.x, wr_multiply(p.y, 3)))", [](V p) { return std::cos(3 * p.x * p.y); }, 1e-5},
         {"wr_exp(wr_sub(p.x, p.z))", [](V p) { return std::exp(p.x - p.z); }, 4e-6},
         {"wr_log(wr_multiply(p.x, p.z))", [](V p) { return std::log(p.x * p.z); }},
         {"wr_pow(wr_multiply(p.x, p.y), 1.75f)", [](V p) { return std::pow(p.x * p.y, 1.75L); }, 4e-5},
         {"wr_pow(p.x, 3)", [](V p) { return p.x * p.x * p.x; }, 1e-5},
         {"wr_abs(wr_sub(p.x, 1.3f))", [](V p) { return std::abs(p.x - real{1.3f}); }},
         {"wr_fract(wr_multiply(p.y, 3))", [](V p) { return 3 * p.y - std::floor(3 * p.y); }},
         {"wr_floor(wr_multiply(p.y, 3))", [](V p) { return std::floor(3 * p.y); }},
         {"wr_min(p.x, wr_multiply(p.y, p.y))", [](V p) { return std::min(p.x, p.y * p.y); }},
         {"wr_max(p.x, wr_multiply(p.y, p.y))", [](V p) { return std::max(p.x, p.y * p.y); }},
         {"wr_clamp(p.x, 0.5f, 1.5f)", [](V p) { return std::clamp(p.x, 0.5L, 1.5L); }},
         {"wr_smoothstep(0.5f, 1.75f, p.z)", [](V p) {
              const real t = std::clamp((p.z - 0.5L) / 1.25L, 0.0L, 1.0L);
              return t * t * (3 - 2 * t);
          }}});
}

real perlin(V p) { return reference::perlin_noise(p).value; }

/// Also where noise moves the points of other noise: the chain rule over three coordinates.
TEST(Dual, Noise) {
    check_formulas("dual noise",
                   {{"wr_perlin(wr_scale(p, (wr_real)(4)))", [](V p) { return perlin(p * 4.0L); }, 2e-5},
                    {"wr_perlin((wr_point){wr_multiply(p.x, p.y), wr_sin(p.z), wr_add(p.x, wr_perlin(p))})",
                     [](V p) {
                         return perlin({p.x * p.y, std::sin(p.z), p.x + perlin(p)});
                     },
                     2e-5}});
}

/// Simplex and cellular noise against their own exact gradients, which are tested elsewhere: what is new is the chain
/// rule, here for a point that is turned and scaled.
TEST(Dual, OtherNoise) {
    cases::Cases c{.name = "dual noise against fields"};
    for (unsigned seed = 1; seed <= 100; ++seed) {
        cases::Random random(seed);
        c.add("dual noise against fields, seed " + std::to_string(seed), false);
        c.in("v", random.box(3));
        c.out("rest", V{0, 0, 0});
    }
    for (const char* pair : {"wr_simplex(q)|wr_simplex_noise(where, form, (wr_real)(1), (wr_real)(0))",
                             "wr_worley(q, WR_F2_F1)|wr_worley_noise(where, WR_F2_F1)"}) {
        const std::string both = pair;
        const std::size_t bar = both.find('|');
        check(c,
              "wr_point p = wr_point_of(v), q = {wr_multiply(p.y, 2), wr_multiply(p.z, -3), p.x};\n"
              "const wr_simplex_form form = {{0, 0, 0}, 0};\n"
              "wr_lattice_point where = wr_lattice_at(wr_v3(2 * v.y, -3 * v.z, v.x));\n"
              "wr_dual d = " +
                  both.substr(0, bar) + ";\nwr_field f = " + both.substr(bar + 1) +
                  ";\n"
                  "wr_vec3 rest = wr_v3(d.gradient.x - f.gradient.z, d.gradient.y - 2 * f.gradient.x,\n"
                  "                     d.gradient.z + 3 * f.gradient.y);\n",
              {{"rest", xyz("rest"), ErrorMeasure::absolute, 1e-6, 1e-6}});
    }
}

/// Where there is no derivative or no value: as documented, and finite.
TEST(Dual, EdgesAreFinite) {
    const std::pair<const char*, std::array<double, 2>> edges[] = {
        {"wr_sqrt(zero)", {0, 0}},
        {"wr_sqrt(wr_sub(zero, 1))", {0, 0}},
        {"wr_divide(one, zero)", {0, 0}},
        {"wr_divide(1, zero)", {0, 0}},
        {"wr_pow(zero, 0.5f)", {0, 0}},
        {"wr_pow(zero, -2)", {0, 0}},
        {"wr_pow(wr_sub(zero, 1), 2)", {0, 0}},
        {"wr_abs(zero)", {0, 0}},
        {"wr_exp(wr_multiply(one, 1000))", {std::exp(88.0), 0}},
        {"wr_log(zero)", {std::log(1e-37), 0}},
        {"wr_length((wr_point){zero, zero, zero})", {0, 0}},
        {"wr_min(zero, wr_multiply(zero, 2))", {0, 1}},
        {"wr_clamp(zero, 0, 1)", {0, 1}},
    };
    for (const auto& [text, want] : edges)
        for (const int lanes : lanes_to_try({1, 4, 16})) {
            const std::string body = "wr_dual zero = wr_variable(v, 0), one = wr_variable(v + 1, 0), f = ";
            const Results r =
                run_kernel({body + text + ";", {"f.value", "f.gradient.x"}}, {{"v", {0, 0}}}, {lanes, false});
            EXPECT_NEAR(r[0][1], want[0], 2e-6 * (1 + std::abs(want[0]))) << text;
            EXPECT_EQ(r[1][1], want[1]) << text;
        }
}

}  // namespace
}  // namespace wrinkle::test
