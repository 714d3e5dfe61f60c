#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
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

/// Times all contenders turn by turn, so that a noisy neighbour disturbs all alike; each warms up once. `all` gets the
/// seconds of every run.
inline void race(std::vector<Contender>& contenders, int repetitions, std::vector<std::vector<double>>* all = nullptr) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int r = -1; r < repetitions; ++r) {
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            contenders[i].work();
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            if (r >= 0) times[i].push_back(seconds);
        }
    }
    for (std::size_t i = 0; i < contenders.size(); ++i) contenders[i].seconds = timing(times[i]);
    if (all) *all = std::move(times);
}

/// "3.42x", or what keeps it from being said: the spread is larger than the effect.
struct Ratio {
    double value = 0, spread = 0;
    bool meaningful = false;
};

/// slow / fast. Of one race: the median of the ratios of its rounds, since what disturbs a round disturbs both; else
/// the ratio of the medians.
inline Ratio ratio(const Timing& slow, const Timing& fast) {
    Ratio r{slow.median / fast.median, std::hypot(slow.spread, fast.spread)};
    if (slow.runs.size() == fast.runs.size() && !slow.runs.empty()) {
        std::vector<double> rounds;
        for (std::size_t i = 0; i < slow.runs.size(); ++i) rounds.push_back(slow.runs[i] / fast.runs[i]);
        const Timing t = timing(rounds);
        r = {t.median, t.spread};
    }
    r.meaningful = std::abs(r.value - 1) > r.spread * r.value;
    return r;
}

/// What may be said of a ratio.
inline std::string text_of(const Ratio& r) { return r.meaningful ? fmt::format("{:.2f}x", r.value) : "not told apart"; }

}  // namespace wrinkle::bench
