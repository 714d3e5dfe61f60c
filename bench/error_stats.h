#pragma once

#include "base/error_stats.h"

namespace wrinkle::bench {

using wrinkle::ErrorStats;
using wrinkle::statistics;

}  // namespace wrinkle::bench
