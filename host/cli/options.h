#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/device.h"

/// Options that several commands take.
namespace wrinkle::cli {

/// Adds --device, whose value Device::open takes.
void add_device_option(CLI::App& command, std::string& device);
/// Adds --lanes, which replaces the device's own choice; 0 without it.
void add_lanes_option(CLI::App& command, int& lanes);
/// Adds --set, which replaces values of a scene's file (scene/set_values.h).
void add_set_option(CLI::App& command, std::vector<std::string>& settings);
/// Opens the device that --device names, to evaluate as many pixels a work-item as --lanes says.
Device open_device(const std::string& device, int lanes);
/// Adds --max-error, which replaces a scene's own. `what` says in the help what the command does with it.
void add_max_error_option(CLI::App& command, std::optional<double>& max_error, const std::string& what);
/// --max-area-error.
void add_max_area_error_option(CLI::App& command, std::optional<double>& max_area_error);

}  // namespace wrinkle::cli
