#pragma once

#include <filesystem>

namespace wrinkle {

/// Whether the name of `file` holds a place for a frame number: a run of #, or %d with an optional width (%4d, %04d). A
/// file that exists under that very name is no pattern. Folders are taken as they are.
bool has_frame_pattern(const std::filesystem::path& file);

/// `pattern` with its frame number filled in: "beauty.####.exr" or "beauty.%04d.exr". A "-" before a negative number
/// comes on top of the digits. Paths without a pattern come back as they are.
std::filesystem::path frame_path(const std::filesystem::path& pattern, int frame);

}  // namespace wrinkle
