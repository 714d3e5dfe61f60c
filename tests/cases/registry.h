#pragma once

#include "tests/cases/cases.h"

namespace wrinkle::cases {

/// The makers of cases for every function of functions(), by the function's name. Inputs have the names of its
/// parameters, answers those of its results; data.constants and data.records hold its settings.
const std::map<std::string, Cases (*)()>& registry();

}  // namespace wrinkle::cases
