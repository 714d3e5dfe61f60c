#pragma once

#include "record.h"

namespace wrinkle::bench {

/// Prints what became slower or less accurate than the spreads explain, and what one of the runs lacks. Speeds are
/// compared as shares of their own run's copy or fma ceiling, so that a slower machine is no regression. Gives false
/// where an error grew.
bool compare(const Run& before, const Run& now);

}  // namespace wrinkle::bench
