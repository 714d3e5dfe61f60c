// The march on heights whose answer is known.
#include "tests/reference/parallax.h"

#include <gtest/gtest.h>

namespace wrinkle::reference {
namespace {

using V2 = Vec2<real>;

/// Heights that count how often they are evaluated.
struct Counted {
    real (*height)(V2);
    int* count;
    real operator()(V2 st) const { return ++*count, height(st); }
};

real march(real (*height)(V2), V2 range, real level, int steps, int refine, int* count = nullptr) {
    int asked = 0;
    const real h =
        parallax_march(Counted{height, &asked}, V2{0.25L, 0.5L}, range, level, 1 / real(steps), steps, refine);
    if (count) *count = asked;
    return h;
}

TEST(ParallaxMarch, OfAFlatHeightIsThatHeight) {
    for (const real level : {0.0L, 0.4L, 1.0L}) {
        EXPECT_NEAR(double(march([](V2) { return 0.37L; }, {2, -1}, level, 8, 0)), 0.37, 1e-15);
        EXPECT_EQ(march([](V2) { return 1.5L; }, {2, -1}, level, 8, 3), 1);
        EXPECT_EQ(march([](V2) { return -0.5L; }, {2, -1}, level, 8, 3), 0);
    }
}

/// The heights h = s, met by rays s = 1/4 + range (h - level). The second ray would meet them below 0, where heights
/// end.
TEST(ParallaxMarch, OfARampIsWhereTheLinesCross) {
    EXPECT_NEAR(double(march([](V2 st) { return st.x; }, {-0.5L, 0}, 0, 16, 0)), 0.25 / 1.5, 1e-15);
    EXPECT_EQ(march([](V2 st) { return st.x; }, {0.5L, 0}, 1, 16, 0), 0);
}

/// Each refinement evaluates the heights once.
TEST(ParallaxMarch, RefinesAsOftenAsAsked) {
    const auto hill = [](V2 st) { return 0.5L + 0.4L * std::sin(4 * st.x); };
    const auto exact = march(hill, {0.3L, 0}, 0, 8, 40);
    real before = 1;
    int base = 0;
    march(hill, {0.3L, 0}, 0, 8, 0, &base);
    for (int refine = 0; refine <= 3; ++refine) {
        int count = 0;
        const real error = std::abs(march(hill, {0.3L, 0}, 0, 8, refine, &count) - exact);
        EXPECT_EQ(count, base + refine);
        EXPECT_LT(error, before);
        before = error;
    }
    EXPECT_LT(before, 1e-5L);
}

/// The first peak hides the higher one behind it.
TEST(ParallaxMarch, StopsAtTheFirstPeak) {
    const auto peaks = [](V2 st) { return (st.x > 0.9L && st.x < 1.1L) || (st.x > 0.4L && st.x < 0.6L) ? 0.8L : 0.0L; };
    EXPECT_NEAR(double(march(peaks, {1, 0}, 0, 64, 16)), 0.8, 0.01);  // from s = 1.25 it meets the far peak
    EXPECT_LT(double(march(peaks, {1, 0}, 0.9L, 64, 16)), 0.25);      // from s = 0.35 it meets no peak on its way
}

}  // namespace
}  // namespace wrinkle::reference
