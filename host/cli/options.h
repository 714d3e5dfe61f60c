#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "wrinkle/device.h"

/// Options that several commands take.
namespace wrinkle::cli {

/// --device, as Device::open takes it.
void add_device_option(CLI::App& command, std::string& device);
/// --lanes, in place of the device's own choice; 0 without it.
void add_lanes_option(CLI::App& command, int& lanes);
/// The device of --device, evaluating as many pixels a work-item as --lanes says.
Device open_device(const std::string& device, int lanes);
/// --max-error, in place of a scene's own. `what` says what the command does with it.
void add_max_error_option(CLI::App& command, std::optional<double>& max_error, const std::string& what);

}  // namespace wrinkle::cli
