#include "bench/measure.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>

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

TEST(Ratio, LiesWithinTheBoundsOfItsMedian) {
    // Sign test: of 100 runs the 40th and 61st hold the median with 96.5%, of 9 the outermost with 99.6%.
    EXPECT_EQ(median_bounds({4, 9, 2, 7, 5, 3, 8, 1, 6}), (std::pair{1.0, 9.0}));
    EXPECT_EQ(median_bounds({3, 1, 2}), (std::pair{1.0, 3.0}));
    std::vector<double> many(100);
    std::iota(many.rbegin(), many.rend(), 1.0);
    EXPECT_EQ(median_bounds(many), (std::pair{40.0, 61.0}));
    const Ratio r = ratio(timing(many), timing(std::vector<double>(100, 2.0)));
    EXPECT_DOUBLE_EQ(r.low, 20);
    EXPECT_DOUBLE_EQ(r.high, 30.5);
}

TEST(Timing, IsTheMedianAndTheQuartiles) {
    const Timing t = timing({5, 1, 4, 2, 3});
    EXPECT_DOUBLE_EQ(t.median, 3);
    EXPECT_DOUBLE_EQ(t.spread, 2.0 / 3);
}

TEST(Race, RunsContendersTurnByTurnInAnyOrder) {
    std::string order;
    std::vector<Contender> contenders{{"a", [&] { order += 'a'; }}, {"b", [&] { order += 'b'; }}};
    race(contenders, {200});
    ASSERT_EQ(order.size(), 402u);  // a warm-up and 200 rounds
    std::size_t a_first = 0;
    for (std::size_t round = 0; round < order.size(); round += 2) {
        EXPECT_NE(order[round], order[round + 1]) << round;
        a_first += order[round] == 'a' ? 1 : 0;
    }
    EXPECT_GT(a_first, 50u);
    EXPECT_LT(a_first, 150u);
}

TEST(Race, GoesOnUntilItTookTheSeconds) {
    const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
    std::vector<Contender> contenders{{"a", wait}, {"b", wait}};
    race(contenders, {3, 0.05});
    const auto total = [](const Timing& t) { return std::accumulate(t.runs.begin(), t.runs.end(), 0.0); };
    EXPECT_GE(total(contenders[0].seconds) + total(contenders[1].seconds), 0.05);
    EXPECT_GT(contenders[0].seconds.runs.size(), 3u);
    EXPECT_EQ(contenders[0].seconds.runs.size(), contenders[1].seconds.runs.size());
}

}  // namespace
}  // namespace wrinkle::bench
