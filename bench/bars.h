#pragma once

#include "record.h"

namespace wrinkle::bench {

/// Every promise whose two measurements a run holds, with its verdict. One table: bars.cpp.
std::vector<Bar> bars_of(const Run& run);

}  // namespace wrinkle::bench
