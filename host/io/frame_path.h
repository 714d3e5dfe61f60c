#pragma once

#include <filesystem>

namespace wrinkle {

/// `pattern` with its frame number filled in: "beauty.####.exr" or "beauty.%04d.exr". A "-" before a negative number
/// comes on top of the digits. Paths without a pattern come back as they are; only the file name is looked at.
std::filesystem::path frame_path(const std::filesystem::path& pattern, int frame);

/// Whether the file name holds a place for the frame number.
bool has_frame_pattern(const std::filesystem::path& pattern);

}  // namespace wrinkle
