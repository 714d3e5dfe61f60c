#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace wrinkle::io {

/// An array of numpy's .npy format. (xtensor's reader, the one in Debian, wants the type of the numbers beforehand, and
/// tells of a wrong one in its own terms.)
template <class T>
struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<T> values;  ///< the last index fastest
};

/// Reads little-endian floats of 4 or 8 bytes in C order; T is float or double. Throws Error for anything else, saying
/// how to convert it, for a file that is cut short, and for a number that T cannot hold.
template <class T>
NpyArray<T> read_npy(const std::filesystem::path& file);

/// A .npy file's bytes before the numbers. T is float or double.
template <class T>
std::string npy_header(std::span<const std::size_t> shape);

}  // namespace wrinkle::io
