#pragma once

#include <functional>

#include "base/error_stats.h"
#include "budget/choose_precision.h"

namespace wrinkle {

/// What a run reports of its error budget.
struct BudgetReport {
    double max_error = 0;                        ///< degrees, as the scene asks
    std::string precision;                       ///< what was computed how
    std::string costs;                           ///< whose table chose it
    double expected_ns = 0, expected_error = 0;  ///< by the table
    ErrorStats measured;                         ///< degrees; of several frames, those of the worst
    int seed = 0;
    std::vector<std::string> misses;  ///< what missed the budget on the way, and what was done
};

/// Keeps a scene's error budget: chooses by the table, and raises what misses.
class Budget {
public:
    /// Throws Error where the outputs as such cannot hold the budget.
    Budget(const Scene& scene, CameraKind camera, const DeviceCosts& costs);

    const PrecisionChoice& choice() const { return choice_; }

    /// Whether a sample that was measured with choice() keeps the budget.
    bool accept(const ErrorStats& measured);

    /// Finds out what missed: measures the choice with each thing in turn a rung higher, and takes the one that helps
    /// most; everything in double where nothing does. Throws Error where that is what missed.
    void raise(const ErrorStats& missed, const std::function<ErrorStats(const PrecisionChoice&)>& measure);

    const BudgetReport& report() const { return report_; }

    /// What of the scene has variants.
    const std::vector<Choosable>& choosables() const { return all_; }

private:
    void take(const PrecisionChoice& choice);

    const Scene& scene_;
    std::vector<Choosable> all_;
    double allowed_ = 0;
    PrecisionChoice choice_;
    BudgetReport report_;
};

}  // namespace wrinkle
