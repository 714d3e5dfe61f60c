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

/// Chooses how exactly a scene is computed, so that its error budget is kept: by the table of costs first, and more
/// exactly where a measurement misses the budget.
class Budget {
public:
    /// Throws Error where 16-bit outputs alone round off more than the budget allows.
    Budget(const Scene& scene, CameraKind camera, const DeviceCosts& costs);

    const PrecisionChoice& choice() const { return choice_; }

    /// Whether a sample that was measured with choice() keeps the budget.
    bool accept(const ErrorStats& measured);

    /// After a miss: measures the choice with the next variant of each part in turn, and takes the one that lowers the
    /// largest error most, or everything in double where none lowers it by much. Throws Error where everything was in
    /// double already.
    void raise(const ErrorStats& missed, const std::function<ErrorStats(const PrecisionChoice&)>& measure);

    const BudgetReport& report() const { return report_; }

    /// The parts of the scene that have variants.
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
