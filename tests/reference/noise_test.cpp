// Noises are compared with tables of their reference algorithms, gradients with finite differences.
#include <gtest/gtest.h>

#include <random>

#include "tests/reference/golden.h"
#include "tests/reference/noise_means.h"
#include "tests/reference/shape.h"

namespace wrinkle::reference {
namespace {

/// Central differences, extrapolated to a step of 0 (Richardson), in long double.
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

TEST(Golden, SimplexNoise) {
    const GoldenTable table = golden("psrdnoise3_glsl");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const NoiseValue<real> n =
            simplex_noise(table.vec(i, "x"), table.vec(i, "period"), real{table.number(i, "alpha")});
        EXPECT_NEAR(n.value, table.number(i, "want_n"), 1e-12L) << table.label(i);
        EXPECT_LE(length(n.gradient - table.vec(i, "want_g")), 1e-12L) << table.label(i);
    }
}

TEST(Noise, GradientIsTheDerivativeOfTheValue) {
    const GoldenTable table = golden("perlin2002_java_reference");
    const std::function<NoiseValue<real>(Vec<real>)> noises[] = {
        [](Vec<real> q) { return perlin_noise(q); },
        [](Vec<real> q) { return perlin_noise(q, true); },
        [](Vec<real> q) {
            return simplex_noise(q, {7, 5, 0}, 0.6L);
        },
    };
    for (std::size_t k = 0; k < std::size(noises); ++k)
        for (std::size_t i = 0; i < table.size(); ++i) {
            const Vec<real> p = table.vec(i, "p");
            const auto value = [&](Vec<real> q) { return noises[k](q).value; };
            // k == 1: on a face of a cell, where the curvature of the cubic fade jumps.
            const real bound = k == 1 ? 2e-4L : 1e-7L;
            EXPECT_LE(length(noises[k](p).gradient - numeric_gradient(value, p, 1e-4L)), bound)
                << "noise " << k << ", case " << i;
        }
}

TEST(Noise, CellularGradientIsTheDerivativeAwayFromItsJumps) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> along(-300, 300);
    int compared = 0;
    for (int i = 0; i < 100; ++i) {
        const Vec<real> p{along(engine), along(engine), along(engine)};
        for (const Cell cell : {Cell::f1, Cell::f2, Cell::f2_f1}) {
            if (distance_to_jump(p, cell) < 0.02L) continue;
            const auto value = [&](Vec<real> q) { return worley_noise(q, cell).value; };
            EXPECT_LE(length(worley_noise(p, cell).gradient - numeric_gradient(value, p, 1e-4L)), 1e-6L) << i;
            ++compared;
        }
    }
    EXPECT_GT(compared, 150);
}

TEST(Noise, FeaturePointsAreWhereF1IsZeroAndRepeatEvery256Cells) {
    const Vec<real> point = Vec<real>{3, -4, 500} + feature_point<real>(3, -4, 500);
    EXPECT_EQ(worley_noise(point, Cell::f1).value, 0);
    EXPECT_EQ(length(worley_noise(point, Cell::f1).gradient), 0);
    EXPECT_EQ(length(feature_point<real>(3, -4, 500) - feature_point<real>(-253, 252, 244)), 0);
}

TEST(Noise, SimplexNoiseTiles) {
    const Vec<real> p{0.3L, -1.7L, 2.2L}, period{4, 3, 0};
    const auto at = [&](Vec<real> q) { return simplex_noise(q, period, 0.4L).value; };
    EXPECT_NEAR(at(p), at(p + Vec<real>{8, -9, 289}), 1e-15L);
    EXPECT_NE(at(p), at(p + Vec<real>{1, 0, 0}));
}

/// One layer for each noise there is.
std::vector<NoiseLayer> all_noises() {
    std::vector<NoiseLayer> layers(6);
    for (int i = 0; i < 6; ++i) {
        layers[i].type = static_cast<NoiseType>(std::min(i, 3));
        layers[i].feature = static_cast<CellFeature>(std::max(i - 3, 0));
    }
    return layers;
}

TEST(Noise, MeansAreThoseOfSamples) {
    for (const NoiseLayer& layer : all_noises()) {
        const bool cells = layer.type == NoiseType::worley;
        const int count = cells ? 10'000 : 100'000;
        std::mt19937 engine(7);
        std::uniform_real_distribution<double> along(0, 289);
        const auto noise = octave_noise<double>(layer);
        NoiseMeans<double> sum;
        for (int i = 0; i < count; ++i) {
            const NoiseValue<double> at = noise(0, {along(engine), along(engine), along(engine)});
            const double n = at.value, g = dot(at.gradient, at.gradient) / 3 / count;
            sum.value += n / count, sum.magnitude += std::abs(n) / count, sum.square += n * n / count;
            sum.slope += g, sum.magnitude_slope += std::abs(n) * g, sum.square_slope += n * n * g;
        }
        const NoiseMeans<double> want = noise_means<double>(layer);
        const double spread = 4 * std::sqrt(want.square / count);  // four standard deviations
        EXPECT_NEAR(sum.value, want.value, spread);
        EXPECT_NEAR(sum.magnitude, want.magnitude, spread);
        EXPECT_NEAR(sum.square, want.square, spread);
        EXPECT_NEAR(sum.slope, want.slope, 0.02 * want.slope);
        EXPECT_NEAR(sum.magnitude_slope, want.magnitude_slope, 0.03 * want.magnitude_slope);
        EXPECT_NEAR(sum.square_slope, want.square_slope, 0.05 * want.square_slope);
    }
}

TEST(Noise, RepeatsEvery256CellsAndIsZeroOnTheLattice) {
    const Vec<real> p{0.25L, -3.5L, 17.125L};
    EXPECT_EQ(perlin_noise(p).value, perlin_noise(p + Vec<real>{256, -512, 1024}).value);
    EXPECT_EQ(perlin_noise(Vec<real>{3, -4, 5}).value, 0);
}

TEST(Fractal, GradientIsTheDerivativeOfTheValue) {
    const OctaveNoise<real> noise = [](int, Vec<real> q) { return perlin_noise(q); };
    for (const Octaves kind : {Octaves::sum, Octaves::turbulence, Octaves::ridged}) {
        const Fractal<real> f{1.5L, 5, 2.1L, 0.45L, kind};
        const auto value = [&](Vec<real> q) { return fractal<real>(f, noise, {}, q, 0).value; };
        int kinks = 0;  // points so near a kink of a magnitude or clamp that there is no derivative
        for (int i = 0; i < 64; ++i) {
            const Vec<real> p{std::sin(i * 1.1L) * 9, std::cos(i * 2.3L) * 7, i * 0.37L - 11};
            const Vec<real> got = fractal<real>(f, noise, {}, p, 0).gradient;
            if (length(got - numeric_gradient(value, p, 1e-5L)) > 1e-7L) ++kinks;
        }
        EXPECT_LE(kinks, kind == Octaves::sum ? 0 : 1);
    }
}

TEST(Fractal, FadedOctavesKeepTheLevelOfTurbulence) {
    const OctaveNoise<real> noise = [](int, Vec<real> q) { return perlin_noise(q); };
    const NoiseMeans<real> means = noise_means<real>(NoiseLayer{});
    const Fractal<real> f{1, 4, 2, 0.5L, Octaves::turbulence};
    const NoiseValue<real> n = fractal<real>(f, noise, means, {0.3L, 0.6L, 0.9L}, 2);
    EXPECT_NEAR(n.value, means.magnitude * 1.875L, 1e-15L);
    EXPECT_EQ(length(n.gradient), 0);
}

TEST(Shape, GradientIsTheDerivativeOfTheValue) {
    const std::function<NoiseValue<real>(const NoiseValue<real>&)> shapes[] = {
        [](const auto& f) { return shape_remap(f, -2.0L, 0.5L); },
        [](const auto& f) { return shape_power(f, 2.5L); },
        [](const auto& f) { return shape_smoothstep(f, 0.1L, 0.9L); },
        [](const auto& f) { return shape_bias(f, 0.2L); },
    };
    for (const auto& shape : shapes)
        for (const real at : {-0.3L, 0.05L, 0.3L, 0.5L, 0.77L, 0.95L, 1.2L}) {
            const auto value = [&](real f) { return shape({f, {}}).value; };
            const real h = 1e-5L, slope = (value(at + h) - value(at - h)) / (2 * h);
            EXPECT_NEAR(shape({at, {1, 0, -2}}).gradient.x, slope, 1e-8L);
            EXPECT_NEAR(shape({at, {1, 0, -2}}).gradient.z, -2 * slope, 1e-8L);
        }
    EXPECT_NEAR(shape_bias(NoiseValue<real>{0.5L, {}}, 0.2L).value, 0.2L, 1e-15L);
}

/// The factor that brings gradients nearest to their means over squares `side` cells wide around them, anywhere and
/// anyhow turned, along their sides.
double regression_on_the_middle(const NoiseLayer& layer, double side) {
    constexpr int kSquares = 3000, kPoints = 12;
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> along(0, 100), within(-side / 2, side / 2);
    std::normal_distribution<double> any;
    const auto random = [&] { return Vec<double>{any(engine), any(engine), any(engine)}; };
    const auto noise = octave_noise<double>(layer);
    double common = 0, own = 0;
    for (int square = 0; square < kSquares; ++square) {
        const Vec<double> middle{along(engine), along(engine), along(engine)};
        const Vec<double> n = normalize(random()), s = normalize(cross(n, random())), t = cross(n, s);
        const Vec<double> at = noise(0, middle).gradient;
        own += dot(at, s) * dot(at, s) + dot(at, t) * dot(at, t);
        for (int k = 0; k < kPoints; ++k) {
            const Vec<double> g = noise(0, middle + s * within(engine) + t * within(engine)).gradient;
            common += (dot(at, s) * dot(g, s) + dot(at, t) * dot(g, t)) / kPoints;
        }
    }
    return common / own;
}

TEST(Fractal, OctavesFadeAsTheirMeanOverAPixelDoes) {
    for (const NoiseLayer& layer : all_noises())
        for (const double cells : {0.25, 0.5, 0.75, 1.0, 1.5})
            EXPECT_NEAR(octave_weight(noise_means<double>(layer), cells), regression_on_the_middle(layer, cells), 0.13)
                << static_cast<int>(layer.type) << " " << static_cast<int>(layer.feature) << " " << cells;
}

TEST(Fractal, OctavesThatNoPixelShowsAreLeftOut) {
    const Vec<real> p{0.3L, 0.6L, 0.9L};
    const Fractal<real> one{1, 1, 2, 0.5L}, six{1, 6, 2, 0.5L};
    EXPECT_EQ(fractal_sum(one, p, 0.8L).value, fractal_sum(six, p, 0.8L).value);
    EXPECT_EQ(fractal_sum(six, p, 1.6L).value, 0);
}

}  // namespace
}  // namespace wrinkle::reference
