#include "bench/ratio.h"

#include <gtest/gtest.h>

#include <numeric>

namespace wrinkle::bench {
namespace {

TEST(Ratio, IsNotSaidWhenTheSpreadIsLargerThanTheEffect) {
    const Timing noisy{1.1, 0.2}, base{1.0, 0.1};
    EXPECT_FALSE(ratio(noisy, base).meaningful);
    EXPECT_EQ(text_of(ratio(noisy, base)), "not told apart");
    EXPECT_FALSE(ratio(base, noisy).meaningful);
}

TEST(Ratio, IsSaidWhenTheEffectIsLargerThanTheSpread) {
    const Timing slow{2.0, 0.2}, fast{1.0, 0.1};
    EXPECT_EQ(text_of(ratio(slow, fast)), "2.00x");
    EXPECT_EQ(text_of(ratio(fast, slow)), "0.50x");
}

TEST(Ratio, ComparesRoundsOfOneRace) {
    // Another user of the machine slows whole rounds down. Medians and spreads are useless then, but in every round the
    // ratio is about 1.5.
    const Timing slow = timing({1.5, 3.0, 1.6, 4.5, 1.4}), fast = timing({1.0, 2.0, 1.1, 3.0, 0.95});
    EXPECT_GT(slow.spread, 0.5);
    const Ratio r = ratio(slow, fast);
    EXPECT_TRUE(r.meaningful);
    EXPECT_NEAR(r.value, 1.5, 0.05);
}

TEST(Ratio, LiesWithinTheBoundsOfItsMedian) {
    // By the sign test, the median lies between the 40th and 61st of 100 runs with 96.5% confidence, between the 2nd
    // and 10th of 11 runs, and between the outermost of 9 runs with 99.6%.
    EXPECT_EQ(median_bounds({4, 9, 2, 7, 5, 3, 8, 1, 6}), (std::pair{1.0, 9.0}));
    EXPECT_EQ(median_bounds({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}), (std::pair{2.0, 10.0}));
    EXPECT_EQ(median_bounds({3, 1, 2}), (std::pair{1.0, 3.0}));
    std::vector<double> many(100);
    std::iota(many.rbegin(), many.rend(), 1.0);
    EXPECT_EQ(median_bounds(many), (std::pair{40.0, 61.0}));
}

TEST(Ratio, TakesPartsOfARaceAsItsMeasurements) {
    // The machine is in one state for half of 1000 rounds and in another for the rest. So many rounds must not narrow
    // the bounds, as they are not independent.
    std::vector<double> slow(1000, 3.0);
    std::fill_n(slow.begin(), 500, 1.0);
    const Ratio r = ratio(timing(slow), timing(std::vector<double>(1000, 1.0)));
    EXPECT_DOUBLE_EQ(r.low, 1);
    EXPECT_DOUBLE_EQ(r.high, 3);
    std::vector<double> rising(45);
    std::iota(rising.begin(), rising.end(), 0.0);
    const std::vector<double> parts = part_medians(rising);
    ASSERT_EQ(parts.size(), 20u);
    EXPECT_DOUBLE_EQ(parts.front(), 0);  // the lower of 0 and 1
    EXPECT_DOUBLE_EQ(parts[3], 7);       // of 6, 7, 8
    EXPECT_DOUBLE_EQ(parts.back(), 43);  // of 42, 43, 44
    EXPECT_EQ(part_medians({2, 1}), (std::vector<double>{2, 1}));
}

}  // namespace
}  // namespace wrinkle::bench
