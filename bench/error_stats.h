#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wrinkle::bench {

/// How wrong: of the finite results, and how many were not.
struct ErrorStats {
    double median = 0, p99 = 0, max = 0;
    std::size_t samples = 0, not_finite = 0;
};

/// Statistics of the errors of `samples` results; NaN and Inf among them are counted apart.
inline ErrorStats statistics(std::vector<double> errors) {
    ErrorStats stats;
    stats.samples = errors.size();
    std::erase_if(errors, [](double e) { return !std::isfinite(e); });
    stats.not_finite = stats.samples - errors.size();
    if (errors.empty()) return stats;
    std::ranges::sort(errors);
    const auto at = [&](double q) {
        return errors[static_cast<std::size_t>(q * static_cast<double>(errors.size() - 1))];
    };
    stats.median = at(0.5), stats.p99 = at(0.99), stats.max = errors.back();
    return stats;
}

}  // namespace wrinkle::bench
