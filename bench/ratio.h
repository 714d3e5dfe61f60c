#pragma once

#include <cmath>
#include <utility>

#include "measure.h"

namespace wrinkle::bench {

/// A ratio of two times, the spread of it from round to round, and bounds of its median.
struct Ratio {
    double value = 0, spread = 0;
    double low = 0, high = 0;
    bool meaningful = false;  ///< it differs from 1 by more than its spread
};

/// Divides the rounds of a race into up to 20 consecutive parts, and gives the median of each. What disturbs one round
/// also disturbs the next, so rounds are not independent measurements; parts nearly are.
inline std::vector<double> part_medians(const std::vector<double>& rounds) {
    constexpr std::size_t kParts = 20;
    const std::size_t parts = std::min(kParts, rounds.size());
    std::vector<double> medians;
    for (std::size_t k = 0; k < parts; ++k) {
        const auto at = [&](std::size_t part) {
            return rounds.begin() + static_cast<std::ptrdiff_t>(part * rounds.size() / parts);
        };
        medians.push_back(timing({at(k), at(k + 1)}).median);
    }
    return medians;
}

/// Two of the values between which the median lies with 95% confidence, whatever their distribution. They are 0.98
/// sqrt(n) ranks from the middle (W. Conover, Practical Nonparametric Statistics, 3.2). Of ten values or fewer, they
/// are the least and the largest; with fewer than six, confidence is lower.
inline std::pair<double, double> median_bounds(std::vector<double> values) {
    std::ranges::sort(values);
    const auto n = static_cast<double>(values.size());
    const auto below = static_cast<std::size_t>(std::max(std::floor((n - 1.96 * std::sqrt(n)) / 2) - 1, 0.0));
    return {values[below], values[values.size() - 1 - below]};
}

/// slow / fast. When both ran in one race, it is the median of the ratios of the rounds, since what disturbs a round
/// disturbs both. Else it is the ratio of the medians, with half the spread either way as its bounds.
inline Ratio ratio(const Timing& slow, const Timing& fast) {
    Ratio r{slow.median / fast.median, std::hypot(slow.spread, fast.spread)};
    r.low = r.value * (1 - r.spread / 2), r.high = r.value * (1 + r.spread / 2);
    if (slow.runs.size() == fast.runs.size() && !slow.runs.empty()) {
        std::vector<double> rounds;
        for (std::size_t i = 0; i < slow.runs.size(); ++i) rounds.push_back(slow.runs[i] / fast.runs[i]);
        const auto [low, high] = median_bounds(part_medians(rounds));
        const Timing t = timing(std::move(rounds));
        r = {t.median, t.spread, low, high};
    }
    r.meaningful = std::abs(r.value - 1) > r.spread * r.value;
    return r;
}

/// "3.42x", or "not told apart" when its spread is larger than its distance from 1.
inline std::string text_of(const Ratio& r) { return r.meaningful ? fmt::format("{:.2f}x", r.value) : "not told apart"; }

}  // namespace wrinkle::bench
