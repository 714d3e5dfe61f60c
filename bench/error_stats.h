#pragma once

#include "run/error_stats.h"

namespace wrinkle::bench {

using wrinkle::ErrorStats;
using wrinkle::statistics;

}  // namespace wrinkle::bench
