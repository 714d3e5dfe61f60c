// Built programs on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace wrinkle {

/// WRINKLE_CACHE_DIR, else wrinkle/ under XDG_CACHE_HOME or ~/.cache; empty where none is set.
std::filesystem::path cache_folder();

/// The file of the program that `key` describes, named by a hash of it; empty where there is no cache folder.
std::filesystem::path cache_file(const std::string& key);

/// A program's binary, and its file marked as used. Empty where the file is missing or damaged, or holds the program of
/// another key with the same hash.
std::vector<unsigned char> read_program(const std::filesystem::path& file, const std::string& key);

/// Writes a program to its cache file, which appears complete or not at all, and then deletes the programs that were
/// not used for longest where the folder holds more than `limit` bytes of them. A cache that cannot be written is no
/// error.
void write_program(const std::filesystem::path& file, const std::string& key, const std::vector<unsigned char>& binary,
                   std::uintmax_t limit = std::uintmax_t{256} << 20);

}  // namespace wrinkle
