#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "io/volume_grid.h"

/// A grid as bytes, for the way from one process to another on the same machine.
namespace wrinkle::io {

std::string pack_grid(const RawVolume& raw, const std::string& name);
std::string pack_failure(const std::string& message);

/// Throws Error with the message that was packed; or, naming `file`, for what is neither that nor a grid: whoever
/// packed it may have been damaged by the file.
std::pair<RawVolume, std::string> unpack_grid(std::span<const std::byte> bytes, const std::string& file);

}  // namespace wrinkle::io
