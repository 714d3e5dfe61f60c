#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// Checks of option values that say what was found and what was expected, where CLI11's own let NaN pass or print code.
namespace wrinkle::cli {

/// A finite number.
CLI::Validator finite();
/// A finite number greater than 0.
CLI::Validator positive();
/// A finite number, 0 or greater.
CLI::Validator not_negative();
/// A number from 0 to 1.
CLI::Validator zero_to_one();

/// One of `names`.
CLI::Validator one_of(const std::vector<std::string>& names);

}  // namespace wrinkle::cli
