#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace wrinkle::io {

/// An array of numpy's .npy format. (Debian's xtensor could read it, but only when the type of the numbers is known
/// beforehand, and its messages about a wrong type are of no use to whoever made the file.)
template <class T>
struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<T> values;  ///< in C order: the last index runs fastest
};

/// Reads little-endian floats of 4 or 8 bytes in C order; T is float or double. Throws Error for anything else, saying
/// how to convert it, for a file that is cut short, and for a number that T cannot hold.
template <class T>
NpyArray<T> read_npy(const std::filesystem::path& file);

/// The header of a .npy file, which the numbers follow. T is float or double.
template <class T>
std::string npy_header(std::span<const std::size_t> shape);

}  // namespace wrinkle::io
