#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "wrinkle/plane_format.h"

namespace wrinkle::cli {

/// Adds --format, which says how a pass of one's own would be given planes.
void add_format_option(CLI::App& command, std::vector<std::string>& formats);
/// The formats that ROLE=ENCODING, or PLANE=ENCODING, stand for: the planes of a role lie in pixels together. Throws
/// Error, naming the nearest encoding.
PlaneFormats formats_of(const std::vector<std::string>& arguments);

}  // namespace wrinkle::cli
