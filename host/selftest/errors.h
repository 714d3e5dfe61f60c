#pragma once

#include <algorithm>
#include <cmath>

#include "base/error_stats.h"
#include "base/vec.h"
#include "wrinkle/functions.h"

/// The errors that functions document, of results and answers in double.
namespace wrinkle::selftest {

inline double length(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }
inline bool is_finite(const Vec3& v) {
    return std::ranges::all_of(v, [](double part) { return std::isfinite(part); });
}
/// In degrees; between nothing and something it is 180.
inline double angle(const Vec3& a, const Vec3& b) {
    const Vec3 u = normalize(a), v = normalize(b);
    if ((length(u) == 0) != (length(v) == 0)) return 180;
    return angle_degrees({u[0], u[1], u[2]}, {v[0], v[1], v[2]});
}

inline const char* unit_of(ErrorMeasure measure) {
    const char* const units[] = {"degrees", "relative", "absolute", "degrees once resolved"};
    return units[static_cast<int>(measure)];
}

/// `n`, the normal that gradients belong to, matters to resolved_degrees only.
inline double error_of(ErrorMeasure measure, const Vec3& got, const Vec3& want, const Vec3& n) {
    const double away = length(subtract(got, want));
    switch (measure) {
        case ErrorMeasure::degrees:
            return away == 0 ? 0 : angle(got, want);
        case ErrorMeasure::relative:
            return away == 0 ? 0 : away / (length(want) > 0 ? length(want) : 1);
        case ErrorMeasure::absolute:
            return away;
        case ErrorMeasure::resolved_degrees:
            return angle(subtract(normalize(n), got), subtract(normalize(n), want));
    }
    return 0;
}

}  // namespace wrinkle::selftest
