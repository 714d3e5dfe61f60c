#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace wrinkle::io {

/// What a .npy file says of itself: the magic bytes, then a Python dict,
/// {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }
struct NpyHeader {
    std::string type;     ///< of plain numbers, "<f4"; empty when there is a list of fields
    std::string records;  ///< the list of fields, without its brackets: ('x', '<f4'), ('y', '<f4')
    std::vector<std::size_t> shape;
    bool fortran_order = false;
    std::size_t data = 0;  ///< where the numbers begin

    /// Elements of the array. Throws Error when no file could hold so many.
    std::size_t count(const std::string& name) const;
};

inline constexpr std::string_view npy_magic = "\x93NUMPY";

/// `text` is the whole file, `name` is for messages. Throws Error for what is no .npy file, or a damaged one.
NpyHeader read_npy_header(std::string_view text, const std::string& name);

}  // namespace wrinkle::io
