// sources/noise_family.clh, sources/cellular.clh: what the rows of the table of functions do not show.
#include "tests/cases/noise.h"
#include "tests/kernels/check.h"
#include "tests/reference/noise_means.h"

namespace wrinkle::test {
namespace {

TEST(Cellular, FindsTheNearestPointsBeyond27Cells) {
    check(cases::worley_search_cases(), "wr_field n = wr_worley_noise(p, WR_F2);",
          {{"value", {"n.value"}, ErrorMeasure::absolute, 1e-6, 1e-6},
           {"gradient", xyz("n.gradient"), ErrorMeasure::absolute, 1e-6, 1e-6}});
}

TEST(Cellular, IsZeroAndFlatOnAFeaturePoint) {
    cases::Cases c{.name = "feature points"};
    for (int i = 0; i < 16; ++i) {
        const V cell{real(7 * i - 40), real(i * i), real(-3 * i)};
        cases::add_noise(c, fmt::format("point {}", i), true,
                         cell + reference::feature_point<real>(7 * i - 40, i * i, -3 * i), {});
    }
    check(c, "wr_field n = wr_worley_noise(p, WR_F1);",
          {{"value", {"n.value"}, ErrorMeasure::absolute, 0, 0},
           {"gradient", xyz("n.gradient"), ErrorMeasure::absolute, 0, 0}});
}

TEST(NoiseFamily, MeansAreThoseOfTheReference) {
    NoiseLayer layer;
    for (int basis = 0; basis < 6; ++basis) {
        layer.type = static_cast<NoiseType>(std::min(basis, 3));
        layer.feature = static_cast<CellFeature>(std::max(basis - 3, 0));
        const auto want = reference::noise_means<double>(layer);
        const Results got =
            run_kernel({fmt::format("wr_noise_means m = wr_noise_mean((wr_noise){{.basis = {}}});", basis),
                        {"(real)(m.value)", "(real)(m.magnitude)", "(real)(m.square)"}},
                       {{"unused", {0}}}, {1, false});
        EXPECT_FLOAT_EQ(static_cast<float>(got[0][0]), static_cast<float>(want.value)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[1][0]), static_cast<float>(want.magnitude)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[2][0]), static_cast<float>(want.square)) << basis;
    }
}

}  // namespace
}  // namespace wrinkle::test
