#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace wrinkle::io {

/// The header of a .npy file. After some magic bytes it is a Python dict:
/// {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }
struct NpyHeader {
    std::string type;     ///< of an array of numbers: "<f4"; empty when elements are records
    std::string records;  ///< fields of the records, without the brackets: ('x', '<f4'), ('y', '<f4')
    std::vector<std::size_t> shape;
    bool fortran_order = false;
    std::size_t data = 0;  ///< where the numbers begin

    /// Number of elements. Throws Error when no file could hold so many.
    std::size_t count(const std::string& name) const;
};

inline constexpr std::string_view npy_magic = "\x93NUMPY";

/// `text` is the whole file, `name` is for messages. Throws Error for what is no .npy file, or a damaged one.
NpyHeader read_npy_header(std::string_view text, const std::string& name);

}  // namespace wrinkle::io
