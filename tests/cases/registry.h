#pragma once

#include "tests/cases/cases.h"

namespace wrinkle::cases {

/// The cases of every row of functions(), by its name: inputs named as its parameters, answers as its results,
/// data.constants and records as its settings.
const std::map<std::string, Cases (*)()>& registry();

}  // namespace wrinkle::cases
