#pragma once

#include <filesystem>
#include <string>

namespace wrinkle::scene {

/// Why `file` cannot be an input, or nothing. With `pattern`, a frame pattern (io/frame_path.h) needs only its folder.
std::string why_not_readable(const std::filesystem::path& file, bool pattern);

}  // namespace wrinkle::scene
