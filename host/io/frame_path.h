#pragma once

#include <filesystem>
#include <string>

namespace wrinkle {

/// Whether the name of `file` holds a place for a frame number: a run of #, %d with an optional width (%4d, %04d), $F
/// or $F4 as Houdini writes it, <frame> or <frame04>. False when a file of exactly that name exists. The names of its
/// folders do not count.
bool has_frame_pattern(const std::filesystem::path& file);

/// Fills a frame number into "beauty.####.exr" or "beauty.%04d.exr". The "-" of a negative number comes before the
/// padded digits. A path without a place for a number is returned as it is.
std::filesystem::path frame_path(const std::filesystem::path& pattern, int frame);

/// The same two for the name of a file that is to be written, whatever files exist.
bool has_frame_place(const std::string& name);
std::string with_frame(std::string name, int frame);

}  // namespace wrinkle
