#pragma once

#include <filesystem>
#include <string>

namespace wrinkle::scene {

/// Why `file` cannot be an input, or nothing. With `pattern`, a frame pattern (io/frame_path.h) needs only its folder.
/// `from` names the folder that relative paths start from.
std::string why_not_readable(const std::filesystem::path& file, bool pattern, const char* from);

}  // namespace wrinkle::scene
