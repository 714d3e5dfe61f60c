#include "bench/measure.h"

#include <gtest/gtest.h>

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
    // A neighbour slows whole rounds down: the medians and their spreads say nothing, the rounds say 1.5.
    const Timing slow = timing({1.5, 3.0, 1.6, 4.5, 1.4}), fast = timing({1.0, 2.0, 1.1, 3.0, 0.95});
    EXPECT_GT(slow.spread, 0.5);
    const Ratio r = ratio(slow, fast);
    EXPECT_TRUE(r.meaningful);
    EXPECT_NEAR(r.value, 1.5, 0.05);
}

TEST(Timing, IsTheMedianAndTheQuartiles) {
    const Timing t = timing({5, 1, 4, 2, 3});
    EXPECT_DOUBLE_EQ(t.median, 3);
    EXPECT_DOUBLE_EQ(t.spread, 2.0 / 3);
}

TEST(Race, RunsContendersTurnByTurn) {
    std::string order;
    std::vector<Contender> contenders{{"a", [&] { order += 'a'; }}, {"b", [&] { order += 'b'; }}};
    race(contenders, 3);
    EXPECT_EQ(order, "abababab");  // a warm-up and 3 rounds
}

}  // namespace
}  // namespace wrinkle::bench
