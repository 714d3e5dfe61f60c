#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace wrinkle::bench {

/// Times of one thing: the median, the distance of the quartiles as a share of it, and the single times, round by
/// round.
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

/// How long a race goes on: until it has had at least so many rounds and has taken at least so many seconds.
struct Rounds {
    int least = 3;
    double seconds = 0;
};

/// What a report says of them.
inline std::string text_of(const Rounds& rounds) {
    return fmt::format("medians of {} runs or more{}", rounds.least,
                       rounds.seconds > 0 ? fmt::format(", races of {:g} s or longer", rounds.seconds) : "");
}

/// Fewer rounds, for work that takes seconds: at most six, which is as few as it takes for the median to lie between
/// the fastest and the slowest with 97% confidence.
inline Rounds few(const Rounds& rounds) { return {std::min(6, rounds.least), rounds.seconds}; }

inline double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Times all contenders in rounds: everyone once a round, so that other users of the machine disturb all of them alike.
/// Rounds alternate between a random order and its reverse, so that none gains or loses by what runs before it. Each
/// contender runs once beforehand, to warm up.
inline void race(std::vector<Contender>& contenders, const Rounds& rounds) {
    if (contenders.empty()) return;
    for (const Contender& contender : contenders) contender.work();
    std::vector<std::vector<double>> times(contenders.size());
    std::vector<std::size_t> order(contenders.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::mt19937 draw(1);
    double taken = 0;
    for (int r = 0; r < rounds.least || taken < rounds.seconds; ++r) {
        if (r % 2 == 0)
            std::ranges::shuffle(order, draw);
        else
            std::ranges::reverse(order);
        for (const std::size_t i : order) taken += times[i].emplace_back(seconds_of(contenders[i].work));
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) contenders[i].seconds = timing(std::move(times[i]));
}

}  // namespace wrinkle::bench
