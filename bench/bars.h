#pragma once

#include "record.h"

namespace wrinkle::bench {

/// The verdict on every promise whose two measurements are in the run. The promises are a table in bars.cpp.
std::vector<Bar> bars_of(const Run& run);

}  // namespace wrinkle::bench
