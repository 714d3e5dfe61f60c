#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace wrinkle::scene {

/// Whether a name stands for many frames: a run of #, or %d with an optional width (%04d).
bool is_frame_pattern(std::string_view name);

/// Why `file` cannot be an input, or nothing. With `pattern`, a name of many frames needs only its folder.
std::string why_not_readable(const std::filesystem::path& file, bool pattern);

/// The whole file. Throws Error when there is none, it is a folder, or it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace wrinkle::scene
