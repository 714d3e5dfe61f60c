// sources/fractal.clh
#include "tests/cases/fractal.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Fractal, WeightAndFootprint) {
    cases::Cases c{.name = "octave weights"};
    for (unsigned seed = 1; seed <= 64; ++seed) {
        cases::Random random(seed);
        const V dx = random.box(1), dy = random.box(2);
        const real cells = random.uniform(0, 1.7L);
        c.add("octave weight, seed " + std::to_string(seed), false);
        c.in("dx", dx), c.in("dy", dy), c.in("cells", cells);
        c.out("weight", reference::octave_weight(reference::perlin_means<real>(), cells));
        c.out("footprint", std::max(length(dx), length(dy)));
    }
    check(c, "",
          {{"weight",
            {"wr_octave_weight(wr_noise_mean((wr_noise){.basis = WR_PERLIN}), cells)"},
            ErrorMeasure::absolute,
            3e-7,
            0},
           {"footprint", {"wr_footprint_size(dx, dy)"}, ErrorMeasure::relative, 3e-7, 0}});
}

}  // namespace
}  // namespace wrinkle::test
