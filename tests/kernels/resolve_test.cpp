// compose/resolve.clh. (functions_test.cpp tests its other functions.)
#include "tests/cases/cases.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Resolve, SlopesAlongTwoAxes) {
    cases::Cases c{.name = "slopes along two axes"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        cases::Random random(seed);
        const bool hard = seed % 2 == 0;
        const V n = random.unit(), right = normalize(cross(n, random.unit())), down = cross(right, n);
        const real size = hard ? random.magnitude(-9, 9) : 1;
        const V2 slope{static_cast<float>(random.uniform(-1, 1) * size),
                       static_cast<float>(random.uniform(-1, 1) * size)};
        c.add("slopes, seed " + std::to_string(seed), hard);
        c.in("n", cases::Random::rounded(n)), c.in("right", cases::Random::rounded(right));
        c.in("down", cases::Random::rounded(down)), c.in("slope", slope);
        const real lift = seed % 3 == 0 ? static_cast<float>(random.uniform(-3, 0.9L)) : 0;
        c.in("lift", lift);
        c.out("bent", normalize(n * (1 - lift) - right * slope.x - down * slope.y));
    }
    check(c, "wr_vec3 bent = wr_resolve_slopes(n, right, down, slope, lift);",
          {{"bent", xyz("bent"), ErrorMeasure::degrees, 2e-5, 2e-5, 1e-5}});
}

}  // namespace
}  // namespace wrinkle::test
