#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Files read whole, text or not.
namespace wrinkle {

/// All of `file`. `expected` names what it should be, for the message when a folder stands there.
///
/// Errors: throws Error, beginning with the file's name, when there is no such file, it is a folder, or reading fails.
std::string read_text(const std::filesystem::path& file, std::string_view expected = "a file");

/// All of standard input. Throws Error.
std::string read_standard_input();

}  // namespace wrinkle
