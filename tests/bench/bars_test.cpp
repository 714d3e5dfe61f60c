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

TEST(Bars, CompareBytesWhereTheySaySo) {
    bench::Run run;
    Measurement resolve{.group = "memory", .name = "resolve", .variant = "standard", .pixels = 1000};
    Measurement triad{.group = "memory", .name = "triad", .variant = "C++ past the cache", .pixels = 1000};
    resolve.seconds = {3, 0.01, {}}, resolve.bytes = 36;
    triad.seconds = {1, 0.01, {}}, triad.bytes = 12;
    run.measurements = {resolve, triad};
    ASSERT_EQ(bars_of(run).size(), 1u);
    EXPECT_DOUBLE_EQ(bars_of(run).front().ratio, 1);
    EXPECT_EQ(bars_of(run).front().verdict, "met");
}

}  // namespace
}  // namespace wrinkle::bench
