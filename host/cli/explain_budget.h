#pragma once

#include <nlohmann/json.hpp>

#include "budget/budget.h"

/// What `wrinkle explain` says of an error budget: the variants a run starts with, and what the table expects of them.
namespace wrinkle::cli {

void print_choice(const Budget& budget);
nlohmann::json choice_json(const Budget& budget);

}  // namespace wrinkle::cli
