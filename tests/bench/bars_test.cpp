#include "bench/bars.h"

#include <gtest/gtest.h>

namespace wrinkle::bench {
namespace {

Measurement stack(const char* variant, double seconds, double spread = 0.01) {
    Measurement m{.group = "stack", .name = "decal_stack", .variant = variant, .pixels = 1000};
    m.seconds = {seconds, spread, {}};
    m.error = {1e-6, 1e-5, 1e-4, 100, 0};
    return m;
}

std::string verdict(const Run& run, const std::string& name) {
    for (const Bar& bar : bars_of(run))
        if (bar.name == name) return bar.verdict;
    return "not measured";
}

TEST(Bars, ComeWithVerdictAndErrors) {
    bench::Run run;
    run.measurements = {stack("standard", 10), stack("plain C++", 50), stack("omp simd, g++", 14),
                        stack("omp simd, clang++", 11)};
    EXPECT_EQ(verdict(run, "8 decals / plain C++"), "met");
    EXPECT_EQ(verdict(run, "8 decals / omp simd"), "missed") << "the faster of the two compilers counts";
    EXPECT_EQ(verdict(run, "8 decals / by hand"), "not measured");
    EXPECT_DOUBLE_EQ(bars_of(run).front().of_p99, 1e-5);
}

TEST(Bars, TakeTheFastestLanes) {
    bench::Run run;
    run.measurements = {stack("standard", 30), stack("standard", 10), stack("plain C++", 50),
                        stack("plain C++, fast-math", 11)};
    EXPECT_EQ(verdict(run, "8 decals / plain C++"), "met") << "and another variant counts only where this one is not";
}

TEST(Bars, SayNothingWithinTheSpread) {
    bench::Run run;
    run.measurements = {stack("standard", 12, 0.2), stack("plain C++", 50, 0.2)};
    EXPECT_EQ(verdict(run, "8 decals / plain C++"), "not told apart");
}

TEST(Bars, ComparePixels) {
    bench::Run run;
    Measurement large{.group = "size", .name = "courtyard", .variant = "33 Mpixel", .pixels = 4000},
        small{.group = "turns", .name = "courtyard", .variant = "8 Mpixel, with 33 Mpixel", .pixels = 1000};
    large.seconds = timing({4.2, 4, 4.4}), small.seconds = timing({1, 1, 1});
    run.measurements = {large, small};
    ASSERT_EQ(bars_of(run).size(), 1u);
    const Bar bar = bars_of(run).front();
    EXPECT_DOUBLE_EQ(bar.ratio, 1.05);
    EXPECT_DOUBLE_EQ(bar.high, 1.1);
    EXPECT_EQ(bar.verdict, "not told apart");
}

TEST(Bars, CompareBytesWhereTheySaySo) {
    bench::Run run;
    Measurement resolve{.group = "memory", .name = "resolve", .variant = "standard", .pixels = 1000};
    Measurement triad{.group = "memory", .name = "triad", .variant = "C++ past the cache", .pixels = 1000};
    resolve.seconds = timing({3, 3.3, 2.7}), resolve.bytes = 36;
    triad.seconds = timing({1, 1, 1}), triad.bytes = 12;
    run.measurements = {resolve, triad};
    ASSERT_EQ(bars_of(run).size(), 1u);
    const Bar bar = bars_of(run).front();
    EXPECT_DOUBLE_EQ(bar.ratio, 1);
    EXPECT_DOUBLE_EQ(bar.low, 0.9);
    EXPECT_DOUBLE_EQ(bar.high, 1.1);
    EXPECT_EQ(bar.verdict, "met");
}

}  // namespace
}  // namespace wrinkle::bench
