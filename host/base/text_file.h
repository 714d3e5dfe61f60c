#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

/// Files read whole, text or not.
namespace wrinkle {

/// What people write is shorter by far; a disk image under the name of a scene is refused unread.
inline constexpr double kLongestText = 64e6;
/// Of tables, which programs write: as long as there is memory for them.
inline constexpr double kAnyLength = std::numeric_limits<double>::infinity();

/// All of `file`. `expected` names what it should be, for the message when a folder stands there.
///
/// Errors: throws Error, beginning with the file's name, when there is no such file, it is a folder or longer than
/// `most` bytes, there is no memory for it, or reading fails.
std::string read_text(const std::filesystem::path& file, std::string_view expected = "a file",
                      double most = kLongestText);

/// All of standard input. Throws Error.
std::string read_standard_input(double most = kLongestText);

}  // namespace wrinkle
