// Perlin noise against the 2002 reference algorithm's table, gradients against finite differences.
#include <gtest/gtest.h>

#include "tests/reference/fractal.h"
#include "tests/reference/golden.h"

namespace wrinkle::reference {
namespace {

/// Central differences extrapolated to step 0 (Richardson), long double.
template <class F>
Vec<real> numeric_gradient(const F& value, Vec<real> p, real step) {
    const auto along = [&](Vec<real> axis) {
        const auto central = [&](real h) { return (value(p + axis * h) - value(p - axis * h)) / (2 * h); };
        return (4 * central(step / 2) - central(step)) / 3;
    };
    return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

TEST(Golden, PerlinNoise) {
    const GoldenTable table = golden("perlin2002_java_reference");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const NoiseValue<real> n = perlin_noise(table.vec(i, "p"));
        EXPECT_NEAR(n.value, table.number(i, "noise_java"), 1e-13L) << "case " << i;
    }
}

TEST(Noise, GradientIsTheDerivativeOfTheValue) {
    const GoldenTable table = golden("perlin2002_java_reference");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> p = table.vec(i, "p");
        const auto value = [](Vec<real> q) { return perlin_noise(q).value; };
        EXPECT_LE(length(perlin_noise(p).gradient - numeric_gradient(value, p, 1e-4L)), 1e-8L) << "case " << i;
    }
}

TEST(Noise, RepeatsEvery256CellsAndIsZeroOnTheLattice) {
    const Vec<real> p{0.25L, -3.5L, 17.125L};
    EXPECT_EQ(perlin_noise(p).value, perlin_noise(p + Vec<real>{256, -512, 1024}).value);
    EXPECT_EQ(perlin_noise(Vec<real>{3, -4, 5}).value, 0);
}

TEST(Fractal, GradientIsTheDerivativeOfTheValue) {
    const Fractal<real> f{1.5L, 5, 2.1L, 0.45L};
    const auto value = [&](Vec<real> q) { return fractal_sum(f, q, 0.0L).value; };
    for (int i = 0; i < 64; ++i) {
        const Vec<real> p{std::sin(i * 1.1L) * 9, std::cos(i * 2.3L) * 7, i * 0.37L - 11};
        EXPECT_LE(length(fractal_sum(f, p, 0.0L).gradient - numeric_gradient(value, p, 1e-5L)), 1e-7L) << i;
    }
}

TEST(Fractal, OctavesAboveTheFootprintsNyquistFrequencyFadeOut) {
    EXPECT_EQ(octave_weight(0.25L), 1);
    EXPECT_EQ(octave_weight(0.375L), 0.5L);
    EXPECT_EQ(octave_weight(0.5L), 0);
    const Vec<real> p{0.3L, 0.6L, 0.9L};
    const Fractal<real> one{1, 1, 2, 0.5L}, six{1, 6, 2, 0.5L};
    EXPECT_EQ(fractal_sum(one, p, 0.25L).value, fractal_sum(six, p, 0.25L).value);
    EXPECT_EQ(fractal_sum(six, p, 0.5L).value, 0);
}

}  // namespace
}  // namespace wrinkle::reference
