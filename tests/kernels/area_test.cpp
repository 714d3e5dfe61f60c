// surface/area.clh
#include "tests/cases/cases.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

const std::string taps_of = "wr_taps taps = wr_taps_of(dp_dx, dp_dy, turn_x, turn_y);\n";

/// Footprints of any shape and size, each seen on a plane that is tilted by `turn`.
cases::Cases footprints() {
    cases::Cases c{.name = "footprints"};
    for (unsigned seed = 1; seed <= 400; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 2 == 0;
        const real size = hard ? random.magnitude(-9, 9) : 0.01L;
        const V x = cases::Random::rounded(random.unit() * size);
        const V y = cases::Random::rounded(seed % 5 == 0 ? cross(normalize(x), random.unit()) * size
                                                         : random.unit() * size * (hard ? random.magnitude(-2, 2) : 1));
        c.add("footprint, seed " + std::to_string(seed), hard);
        c.in("dp_dx", x), c.in("dp_dy", y);
        c.in("turn_x", random.uniform(-0.1L, 0.1L)), c.in("turn_y", hard ? random.uniform(-3, 3) : 0);
        // Singular values of the 3 x 2 matrix (dp_dx dp_dy): their squares' sum, and their product, the area.
        const V across = cross(x, y);
        const real sum = dot(x, x) + dot(y, y), area = length(across);
        const real longer = std::sqrt((sum + std::sqrt(std::max(sum * sum - 4 * area * area, real{0}))) / 2);
        c.out("long", longer), c.out("short", area / longer);
        c.out("angle", real{0}), c.out("weights", real{1});
    }
    return c;
}

TEST(Area, AxesAreTheSingularVectors) {
    // The short axis is as exact as the long one: relative to it.
    check(
        footprints(),
        taps_of +
            "wr_real longer = sqrt(wr_dot(taps.along, taps.along)), shorter = sqrt(wr_dot(taps.across, taps.across));\n"
            "wr_real angle = wr_dot(wr_scale(taps.along, 1 / longer), wr_scale(taps.across, 1 / longer));\n"
            "wr_real ratio = shorter / longer;",
        {{"long", {"longer"}, ErrorMeasure::relative, 1e-6, 1e-6, 1e-12},
         {"angle", {"angle"}, ErrorMeasure::absolute, 1e-6, 1e-6, 1e-12}});
}

TEST(Area, SharesAddUpToThePixel) {
    check(footprints(),
          taps_of +
              "taps.count = wr_tap_count(taps, 16, dp_dx.x == dp_dx.x);\n"
              "wr_shares shares = wr_shares_of(taps);\n"
              "wr_real weights = 0;\n"
              "for (int i = 0; i < 16; ++i) {\n"
              "    wr_real weight, shift = wr_tap_at(taps, shares, i, &weight);\n"
              "    weights += taps.count > i ? weight : (wr_real)(0);\n"
              "}",
          {{"weights", {"weights"}, ErrorMeasure::absolute, 1e-5, 2e-5, 1e-12}});
}

TEST(Area, PointsLieOnThePlane) {
    // A plane 2 m below the eye, seen along (0, 1, -0.1): the ray through y pixels meets it at 2 d / (0.1 + 0.01 y).
    cases::Cases c{.name = "points on a plane"};
    for (int i = 0; i < 16; ++i) {
        const auto at = [](real y) { return V{0, 1, -0.1L - 0.01L * y} * (2 / (0.1L + 0.01L * y)); };
        const V step = (at(1e-6L) - at(-1e-6L)) / 2e-6L, p = at(0);
        c.add("point " + std::to_string(i), false);
        c.in("p", p), c.in("dp_dx", V{0.02L, 0, 0}), c.in("dp_dy", step), c.in("number", real(i));
        // Shares are equally long on the surface; where the middle of one is seen follows from the plane.
        const real begin = at(-0.5L).y - p.y, end = at(0.5L).y - p.y, y = begin + (end - begin) * (i + 0.5L) / 16;
        c.out("point", V{0, y, 0});
        const auto pixel = [&](real along) { return (2 / (p.y + along) - 0.1L) / 0.01L; };
        c.out("weight", pixel(begin + (end - begin) * (i + 1) / 16) - pixel(begin + (end - begin) * i / 16));
    }
    check(
        c,
        "wr_vec3 forward = wr_v3((wr_real)(0), (wr_real)(1), (wr_real)(0));\n"
        "wr_taps taps = wr_taps_of(dp_dx, dp_dy, wr_depth_turn(forward, p, dp_dx), wr_depth_turn(forward, p, dp_dy));\n"
        "taps.count = 16;\n"
        "wr_real weight = 0, shift = 0;\n"
        "for (int i = 0; i < 16; ++i) {\n"
        "    wr_real each, at = wr_tap_at(taps, wr_shares_of(taps), i, &each);\n"
        "    weight = number == i ? each : weight, shift = number == i ? at : shift;\n"
        "}\n"
        "wr_vec3 point = wr_scale(taps.along, shift);",
        {{"point", xyz("point"), ErrorMeasure::relative, 3e-5, 3e-5, 1e-9},
         {"weight", {"weight"}, ErrorMeasure::relative, 3e-5, 3e-5, 1e-9}});
}

TEST(Area, SidesHaveTheirCovariance) {
    cases::Cases c{.name = "sides of a covariance"};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 2 == 0;
        const real size = hard ? random.magnitude(-9, 9) : 1;
        const real x = random.uniform(0, 1), y = random.uniform(0, 1), turn = random.uniform(-1, 1);
        const V spread = cases::Random::rounded(
            V{seed % 7 == 0 ? 0 : x * x, seed % 7 == 0 ? 0 : x * y * turn, seed % 5 == 0 ? 0 : y * y} * size);
        c.add("sides, seed " + std::to_string(seed), hard);
        c.in("spread", seed % 5 == 0 ? V{spread.x, 0, 0} : spread);
        c.out("mean", V{}), c.out("spread", seed % 5 == 0 ? V{spread.x, 0, 0} : spread);
    }
    check(c,
          "wr_vec3 got = wr_zero3();\n"
          "wr_vec2 mean = wr_v2((wr_real)(0), (wr_real)(0));\n"
          "for (int i = 0; i < 4; ++i) {\n"
          "    wr_vec2 s = wr_side(wr_sides_of(spread), (wr_real)((WR_SCALAR)i));\n"
          "    mean = wr_add(mean, s);\n"
          "    got = wr_fma(wr_v3(s.x * s.x, s.x * s.y, s.y * s.y), (wr_real)(0.25f), got);\n"
          "}\n"
          "wr_vec3 off = wr_v3(mean.x, mean.y, (wr_real)(0));",
          {{"mean", xyz("off"), ErrorMeasure::absolute, 0, 0, 0},
           {"spread", xyz("got"), ErrorMeasure::relative, 1e-6, 1e-6, 1e-12}});
}

TEST(Area, TheAxisToTheRightIsOnTheSurfaceWhateverItsStep) {
    cases::Cases c{.name = "axes to the right"};
    for (unsigned seed = 1; seed <= 100; ++seed) {
        cases::Random random(seed);
        const V n = cases::Random::rounded(
            seed <= 6 ? V{seed / 2 == 0 ? 1.0L : 0, seed / 2 == 1 ? 1.0L : 0, seed / 2 > 1 ? -1.0L : 0}
                      : random.unit());
        const bool none = seed % 2 == 0;
        const V step = cases::Random::rounded(cross(n, random.unit()) * random.magnitude(-30, 6));
        c.add("axis, seed " + std::to_string(seed), none);
        c.in("n", n), c.in("dp_dx", none ? V{0, 0, 0} : step);
        c.out("size", real{1}), c.out("off", real{0});
        c.out("along", real{1});
    }
    check(c,
          "wr_vec3 right = wr_right_on_surface(n, dp_dx);\n"
          "wr_real size = sqrt(wr_dot(right, right)), off = wr_dot(n, right);\n"
          "wr_real along = wr_nonzero(dp_dx) ? wr_dot(right, wr_normalize(dp_dx)) : (wr_real)(1);",
          {{"size", {"size"}, ErrorMeasure::absolute, 3e-7, 3e-7, 1e-12},
           {"off", {"off"}, ErrorMeasure::absolute, 1e-6, 1e-6, 1e-6},
           {"along", {"along"}, ErrorMeasure::absolute, 3e-7, 3e-7, 1e-12}});
}

/// Differences of means may leave an xy that no covariance with such an xx has.
TEST(Area, SidesOfWhatIsNoCovarianceStayWithinTheLargerDeviation) {
    cases::Cases c{.name = "sides of rounded covariances"};
    for (const V& spread : {V{1e-12L, 1e-6L, 0.06L}, V{1e-30L, -1e-9L, 0.1L}, V{0.1L, 0.2L, 0}, V{0, 0.1L, 0.04L}}) {
        c.add("sides", true);
        c.in("spread", cases::Random::rounded(spread)), c.out("beyond", real{0});
    }
    check(c,
          "wr_real beyond = 0, most = sqrt(2 * fmax(spread.x, spread.z)) * (wr_real)(1.000001f);\n"
          "for (int i = 0; i < 4; ++i) {\n"
          "    wr_vec2 s = wr_side(wr_sides_of(spread), (wr_real)((WR_SCALAR)i));\n"
          "    beyond = fmax(beyond, fmax(fabs(s.x), fabs(s.y)) - most);\n"
          "}\n",
          {{"beyond", {"beyond"}, ErrorMeasure::absolute, 0, 0, 0}});
}

TEST(Area, CovarianceTurnsWithItsAxes) {
    cases::Cases c{.name = "covariances"};
    for (unsigned seed = 1; seed <= 100; ++seed) {
        cases::Random random(seed);
        // Of four equally likely slopes.
        V2 slopes[4];
        V2 mean{0, 0};
        real ss = 0, st = 0, tt = 0;
        for (V2& d : slopes) {
            d = {random.uniform(-1, 1), random.uniform(-1, 1)};
            mean = mean + d * real{0.25L}, ss += d.x * d.x / 4, st += d.x * d.y / 4, tt += d.y * d.y / 4;
        }
        const V2 s{random.uniform(-1, 1), random.uniform(-1, 1)}, t{random.uniform(-1, 1), random.uniform(-1, 1)};
        const real scale = random.uniform(0.5L, 2);
        V want{0, 0, 0};
        for (const V2& d : slopes) {
            const V2 g = (s * (d.x - mean.x) + t * (d.y - mean.y)) * scale;
            want = want + V{g.x * g.x, g.x * g.y, g.y * g.y} * real{0.25L};
        }
        c.add("covariance, seed " + std::to_string(seed), false);
        c.in("products", V{ss, st, tt}), c.in("mean", mean), c.in("s", s), c.in("t", t), c.in("scale", scale);
        c.out("spread", want);
    }
    check(c, "wr_vec3 spread = wr_spread_along(wr_lost_spread(products, mean), scale, s, t);",
          {{"spread", xyz("spread"), ErrorMeasure::absolute, 3e-6, 3e-6, 1e-5}});
}

}  // namespace
}  // namespace wrinkle::test
