// sources/noise_family.clh, sources/cellular.clh: what functions_test.cpp does not test.
#include <cmath>
#include <random>

#include "tests/cases/noise.h"
#include "tests/kernels/check.h"
#include "tests/reference/noise_means.h"

namespace wrinkle::test {
namespace {

TEST(Cellular, FindsTheNearestPointsBeyond27Cells) {
    check(cases::worley_search_cases(), "wr_field n = wr_worley_noise(wr_lattice_at(p), WR_F2);",
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
    check(c, "wr_field n = wr_worley_noise(wr_lattice_at(p), WR_F1);",
          {{"value", {"n.value"}, ErrorMeasure::absolute, 0, 0},
           {"gradient", xyz("n.gradient"), ErrorMeasure::absolute, 0, 0}});
}

/// A far point in a small cell, given as a pair of floats, has its place within the cell to all digits of a float.
TEST(Lattice, PairsKeepTheDigitsOfFarPoints) {
    cases::Cases c{.name = "lattice point"};
    c.data.constants_per_row = 8;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        cases::Random random(seed);
        const V p = random.box(random.magnitude(-2, 3)), rest = p * 0x1p-25L * random.uniform(-1, 1);
        const real frequency = 0.1L + random.magnitude(-1, 2.5L);
        const V origin{random.uniform(0, 256) / 3, random.uniform(0, 256) / 7, random.uniform(0, 289) / 11};
        c.add(fmt::format("seed {}", seed), seed > 100);
        c.in("p", p), c.in("rest", cases::Random::rounded(rest));
        const real numbers[] = {origin.x, origin.y, origin.z, frequency};
        for (const real v : numbers) c.data.constants.push_back(static_cast<float>(v));
        for (const real v : numbers) c.data.constants.push_back(static_cast<double>(v - static_cast<float>(v)));
        const V q = (p + cases::Random::rounded(rest)) * frequency + origin;
        const V cell{std::floor(q.x), std::floor(q.y), std::floor(q.z)};
        c.out("cell", cell), c.out("part", q - cell);
    }
    ColumnKernel kernel{"wr_lattice_point point = wr_lattice_at(wr_pairs(p, rest), constants, constants + 4);",
                        xyz("point.cell")};
    for (const std::string& part : xyz("point.part")) kernel.outputs.push_back(part);
    for (const int lanes : lanes_to_try()) {  // float only: in double, constants are not split into pairs
        const Results got = run_kernel(kernel, c.inputs, {lanes, false}, c.data);
        for (std::size_t row = 0; row < c.size(); ++row) {
            const V at = cases::value_at(got, 0, 3, row) + cases::value_at(got, 3, 3, row);
            const V want = c.want.at("cell")[row] + c.want.at("part")[row], part = cases::value_at(got, 3, 3, row);
            EXPECT_LE(double(reference::length(at - want)), 2e-7) << lanes << " lanes, " << c.labels[row];
            for (const real v : {part.x, part.y, part.z}) EXPECT_TRUE(v >= 0 && v < 1) << c.labels[row];
        }
    }
}

TEST(NoiseFamily, MeansAreThoseOfTheReference) {
    NoiseLayer layer;
    for (int basis = 0; basis < 6; ++basis) {
        layer.type = static_cast<NoiseType>(std::min(basis, 3));
        layer.feature = static_cast<CellFeature>(std::max(basis - 3, 0));
        const auto want = reference::noise_means<double>(layer);
        const Results got =
            run_kernel({fmt::format("wr_noise_means m = wr_noise_mean((wr_noise){{.basis = {}}});", basis),
                        {"(wr_real)(m.value)", "(wr_real)(m.magnitude)", "(wr_real)(m.square)", "(wr_real)(m.slope)",
                         "(wr_real)(m.magnitude_slope)", "(wr_real)(m.square_slope)"}},
                       {{"unused", {0}}}, {1, false});
        EXPECT_FLOAT_EQ(static_cast<float>(got[0][0]), static_cast<float>(want.value)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[1][0]), static_cast<float>(want.magnitude)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[2][0]), static_cast<float>(want.square)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[3][0]), static_cast<float>(want.slope)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[4][0]), static_cast<float>(want.magnitude_slope)) << basis;
        EXPECT_FLOAT_EQ(static_cast<float>(got[5][0]), static_cast<float>(want.square_slope)) << basis;
    }
}

/// The share of the variance of a noise's gradient that lies within squares `side` cells wide, anywhere and anyhow
/// turned, along their sides; measured at 8 x 8 points of each.
double share_within(const NoiseLayer& layer, double side) {
    constexpr int kSquares = 300, kPoints = 8;
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> along(0, 100);
    std::normal_distribution<double> any;
    const auto noise = reference::octave_noise<double>(layer);
    using V3 = reference::Vec<double>;
    double all = 0, within = 0;
    for (int square = 0; square < kSquares; ++square) {
        const V3 corner{along(engine), along(engine), along(engine)};
        const V3 n = normalize(V3{any(engine), any(engine), any(engine)});
        const V3 s = normalize(cross(n, V3{any(engine), any(engine), any(engine)})), t = cross(n, s);
        double sum[2]{}, squares[2]{};
        for (int k = 0; k < kPoints * kPoints; ++k) {
            const double x = (k % kPoints + 0.5) / kPoints, y = (k / kPoints + 0.5) / kPoints;
            const V3 g = noise(0, corner + s * (side * x) + t * (side * y)).gradient;
            const double parts[]{dot(g, s), dot(g, t)};
            for (int c = 0; c < 2; ++c) sum[c] += parts[c], squares[c] += parts[c] * parts[c];
        }
        for (int c = 0; c < 2; ++c) {
            all += squares[c];
            within += squares[c] - sum[c] * sum[c] / (kPoints * kPoints);
        }
    }
    return within / all;
}

TEST(NoiseFamily, GrainTellsWhatLiesWithinAPixel) {
    NoiseLayer layer;
    for (int basis = 0; basis < 6; ++basis) {
        layer.type = static_cast<NoiseType>(std::min(basis, 3));
        layer.feature = static_cast<CellFeature>(std::max(basis - 3, 0));
        const Results got =
            run_kernel({fmt::format("wr_noise_means m = wr_noise_mean((wr_noise){{.basis = {}}});", basis),
                        {"(wr_real)(m.grain)"}},
                       {{"unused", {0}}}, {1, false});
        const double grain = got[0][0];
        EXPECT_NEAR(0.0625 / (0.0625 + grain), share_within(layer, 0.25), 0.06) << basis;
        EXPECT_NEAR(0.25 / (0.25 + grain), share_within(layer, 0.5), 0.12) << basis;
    }
}

}  // namespace
}  // namespace wrinkle::test
