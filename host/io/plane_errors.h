#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/image_parts.h"

namespace wrinkle::io {

/// Throws Error saying which channels there are, and how to name the one that holds a plane that was not found. Those
/// of a file that has the picture alone are listed apart, where it was looked into as well.
[[noreturn]] void fail_missing_plane(std::string_view plane, std::span<const std::string> channels,
                                     const std::filesystem::path& file,
                                     std::span<const std::string> beauty_channels = {},
                                     const std::filesystem::path& beauty_file = {});

/// Throws Error where a plane of Cryptomatte ids is stored with fewer bits than they have.
void require_whole_ids(std::string_view plane, const ChannelPlace& place, const std::filesystem::path& file);

}  // namespace wrinkle::io
