#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// Checks of option values. Unlike CLI11's own they refuse NaN, and their messages say what was found and what is
/// expected.
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
