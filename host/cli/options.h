#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

/// Options that several commands take.
namespace wrinkle::cli {

/// Adds --device, whose value Device::open takes.
void add_device_option(CLI::App& command, std::string& device);
/// Adds --max-error, which replaces a scene's own. `what` says in the help what the command does with it.
void add_max_error_option(CLI::App& command, std::optional<double>& max_error, const std::string& what);

}  // namespace wrinkle::cli
