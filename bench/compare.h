#pragma once

#include "record.h"

namespace wrinkle::bench {

/// Prints which measurements became slower or less accurate by more than their spreads explain, and which of them only
/// one run has. Speeds are compared as shares of their own run's ceilings, so that a slower machine does not count as
/// slower code. Returns false when an error grew.
bool compare(const Run& before, const Run& now);

}  // namespace wrinkle::bench
