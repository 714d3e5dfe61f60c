#pragma once

#include <string>
#include <vector>

#include "record.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

struct FunctionBench {
    std::string only;             ///< a name; empty: all functions
    std::vector<int> lanes{};     ///< empty: the device's own
    std::size_t rows = 1u << 18;  ///< rows a launch: the regular inputs of the cases, repeated
    int repetitions = 9;
    bool speed = true;  ///< false: errors only, speeds are 0
};

/// Every function of functions() in every variant, and in double. Times are of regular inputs, errors of the regular
/// and of each category of hard inputs of its cases (tests/cases).
std::vector<Measurement> measure_functions(const Device& device, const FunctionBench& options);

}  // namespace wrinkle::bench
