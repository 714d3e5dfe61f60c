#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace wrinkle::bench {

/// Times of one thing: median, and the spread between the quartiles as a share of it.
struct Timing {
    double median = 0, spread = 0;
};

inline Timing timing(std::vector<double> times) {
    std::ranges::sort(times);
    const auto at = [&](double q) {
        return times[static_cast<std::size_t>(q * static_cast<double>(times.size() - 1))];
    };
    return {at(0.5), (at(0.75) - at(0.25)) / at(0.5)};
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
    double value = 0;
    bool meaningful = false;
};

inline Ratio ratio(const Timing& slow, const Timing& fast) {
    const double value = slow.median / fast.median;
    return {value, std::abs(value - 1) > std::hypot(slow.spread, fast.spread)};
}

}  // namespace wrinkle::bench
