#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wrinkle {

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

/// Angle between two vectors in degrees; NaN where one of them is not finite.
inline double angle_degrees(const double (&a)[3], const double (&b)[3]) {
    constexpr double kDegrees = 57.29577951308232;
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return std::atan2(std::hypot(x, y, z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * kDegrees;
}

}  // namespace wrinkle
