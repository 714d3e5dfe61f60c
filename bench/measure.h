#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace wrinkle::bench {

/// Times of one thing: median, and the spread between the quartiles as a share of it; the single runs, in the order
/// of a race, where there was one.
struct Timing {
    double median = 0, spread = 0;
    std::vector<double> runs{};
};

inline Timing timing(std::vector<double> runs) {
    std::vector<double> times = runs;
    std::ranges::sort(times);
    const auto at = [&](double q) {
        return times[static_cast<std::size_t>(q * static_cast<double>(times.size() - 1))];
    };
    return {at(0.5), (at(0.75) - at(0.25)) / at(0.5), std::move(runs)};
}

/// A contender: `work` does the whole job once and returns when it is done.
struct Contender {
    std::string name;
    std::function<void()> work;
    Timing seconds{};
};

/// How long a race goes on: until it has had so many rounds, and has taken so many seconds.
struct Rounds {
    int least = 3;
    double seconds = 0;
};

/// What a report says of them.
inline std::string text_of(const Rounds& rounds) {
    return fmt::format("medians of {} runs or more{}", rounds.least,
                       rounds.seconds > 0 ? fmt::format(", races of {:g} s or longer", rounds.seconds) : "");
}

/// A third of the rounds, for work that takes seconds.
inline Rounds few(const Rounds& rounds) { return {std::max(3, rounds.least / 3), rounds.seconds}; }

inline double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Times all contenders turn by turn, so that a noisy neighbour disturbs all alike, every round in an order of its own,
/// so that none profits or suffers by what runs before it; each warms up once.
inline void race(std::vector<Contender>& contenders, const Rounds& rounds) {
    for (const Contender& contender : contenders) contender.work();
    std::vector<std::vector<double>> times(contenders.size());
    std::vector<std::size_t> order(contenders.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 draw(1);
    double taken = 0;
    for (int r = 0; r < rounds.least || taken < rounds.seconds; ++r) {
        std::ranges::shuffle(order, draw);
        for (const std::size_t i : order) taken += times[i].emplace_back(seconds_of(contenders[i].work));
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) contenders[i].seconds = timing(std::move(times[i]));
}

/// "3.42x", or what keeps it from being said: the spread is larger than the effect.
struct Ratio {
    double value = 0, spread = 0;
    double low = 0, high = 0;  ///< the value is known to lie within
    bool meaningful = false;
};

/// Between which of their values the median of such runs lies, with 95% confidence, whatever their distribution: ranks
/// 0.98 sqrt(n) from the middle (W. Conover, Practical Nonparametric Statistics, 3.2); of eleven or fewer, the
/// outermost.
inline std::pair<double, double> median_bounds(std::vector<double> runs) {
    std::ranges::sort(runs);
    const auto n = static_cast<double>(runs.size());
    const auto below = static_cast<std::size_t>(std::max(std::floor((n - 1.96 * std::sqrt(n)) / 2) - 1, 0.0));
    return {runs[below], runs[runs.size() - 1 - below]};
}

/// slow / fast. Of one race: the median of the ratios of its rounds, since what disturbs a round disturbs both; else
/// the ratio of the medians.
inline Ratio ratio(const Timing& slow, const Timing& fast) {
    Ratio r{slow.median / fast.median, std::hypot(slow.spread, fast.spread)};
    r.low = r.value * (1 - r.spread / 2), r.high = r.value * (1 + r.spread / 2);
    if (slow.runs.size() == fast.runs.size() && !slow.runs.empty()) {
        std::vector<double> rounds;
        for (std::size_t i = 0; i < slow.runs.size(); ++i) rounds.push_back(slow.runs[i] / fast.runs[i]);
        const auto [low, high] = median_bounds(rounds);
        const Timing t = timing(std::move(rounds));
        r = {t.median, t.spread, low, high};
    }
    r.meaningful = std::abs(r.value - 1) > r.spread * r.value;
    return r;
}

/// What may be said of a ratio.
inline std::string text_of(const Ratio& r) { return r.meaningful ? fmt::format("{:.2f}x", r.value) : "not told apart"; }

}  // namespace wrinkle::bench
