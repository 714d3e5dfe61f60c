#include "bench/measure.h"

#include <gtest/gtest.h>

#include <thread>

namespace wrinkle::bench {
namespace {

TEST(Timing, IsTheMedianAndTheQuartiles) {
    const Timing t = timing({5, 1, 4, 2, 3});
    EXPECT_DOUBLE_EQ(t.median, 3);
    EXPECT_DOUBLE_EQ(t.spread, 2.0 / 3);
}

TEST(Race, RunsContendersTurnByTurnEachFirstAsOften) {
    std::string order;
    std::vector<Contender> contenders{{"a", [&] { order += 'a'; }}, {"b", [&] { order += 'b'; }}};
    race(contenders, {6});
    ASSERT_EQ(order.size(), 14u);  // a warm-up and 6 rounds
    std::size_t a_first = 0;
    for (std::size_t round = 2; round < order.size(); round += 2) {
        EXPECT_NE(order[round], order[round + 1]) << round;
        a_first += order[round] == 'a' ? 1 : 0;
    }
    EXPECT_EQ(a_first, 3u);
}

std::function<void()> sleep_for(int milliseconds) {
    return [milliseconds] { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); };
}

TEST(Race, GivesEveryContenderItsOwnTimes) {
    std::vector<Contender> contenders{{"1", sleep_for(1)}, {"40", sleep_for(40)}, {"10", sleep_for(10)}};
    race(contenders, {5});
    EXPECT_LT(contenders[0].seconds.median, contenders[2].seconds.median);
    EXPECT_LT(contenders[2].seconds.median, contenders[1].seconds.median);
    EXPECT_GE(contenders[1].seconds.median, 0.04);
}

TEST(Race, GoesOnUntilItTookTheSeconds) {
    std::vector<Contender> contenders{{"a", sleep_for(1)}, {"b", sleep_for(1)}};
    race(contenders, {1, 0.1});
    double total = 0;
    for (const Contender& contender : contenders)
        for (const double seconds : contender.seconds.runs) total += seconds;
    EXPECT_GE(total, 0.1);
    EXPECT_EQ(contenders[0].seconds.runs.size(), contenders[1].seconds.runs.size());
}

TEST(Race, OfNobodyEnds) {
    std::vector<Contender> nobody;
    race(nobody, {1, 1});
}

}  // namespace
}  // namespace wrinkle::bench
