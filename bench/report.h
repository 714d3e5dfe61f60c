#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "error.h"
#include "measure.h"

namespace wrinkle::bench {

/// One line: how long, how wrong.
struct Row {
    std::string name;
    Timing seconds;
    ErrorStats error;
};

/// Everything that a run measured.
struct Report {
    std::string device, processor;
    Size size;
    int repetitions = 0;
    std::vector<Row> rows;    ///< the demo scene by each contender
    std::vector<Row> layers;  ///< each layer alone, its share above the empty scene
    double copy_gb_s = 0, resolve_gb_s = 0, baseline_resolve_gb_s = 0;
    double cold_build = 0, warm_build = 0;  ///< seconds
    double run_outside = 0;                 ///< seconds of a warm `wrinkle run` outside reading, kernels and writing
};

void print(const Report& report);
nlohmann::json to_json(const Report& report);
/// The processor's name as the system gives it.
std::string processor_name();

}  // namespace wrinkle::bench
