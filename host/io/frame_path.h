#pragma once

#include <filesystem>

namespace wrinkle {

/// Whether the name of `file` holds a place for a frame number: a run of #, or %d with an optional width (%4d, %04d).
/// False when a file of exactly that name exists. The names of its folders do not count.
bool has_frame_pattern(const std::filesystem::path& file);

/// Fills a frame number into "beauty.####.exr" or "beauty.%04d.exr". The "-" of a negative number comes before the
/// padded digits. A path without a place for a number is returned as it is.
std::filesystem::path frame_path(const std::filesystem::path& pattern, int frame);

}  // namespace wrinkle
