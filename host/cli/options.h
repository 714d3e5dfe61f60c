#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

/// Options that several commands take.
namespace wrinkle::cli {

/// --device, as Device::open takes it.
void add_device_option(CLI::App& command, std::string& device);
/// --max-error, in place of a scene's own. `what` says what the command does with it.
void add_max_error_option(CLI::App& command, std::optional<double>& max_error, const std::string& what);

}  // namespace wrinkle::cli
