#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/input_file.h"

/// What lies around the grids of a NanoVDB file. NanoVDB's own reader takes every length of the file at its word.
namespace wrinkle::io {

/// A grid as its file lists it.
struct NvdbGrid {
    std::string name;
    std::uint32_t type = 0;            ///< NanoVDB's number
    std::uint64_t bytes = 0;           ///< in memory
    std::uint64_t at = 0, stored = 0;  ///< where in the file it is, and how many bytes it takes there
    std::uint16_t codec = 0;
};

/// Throws Error, saying what is wrong, unless every grid lies within the file and can be as large as it claims.
std::vector<NvdbGrid> list_nvdb_grids(const InputFile& file);

/// Unpacks a grid into memory of its size. Throws Error when it is damaged.
void unpack_nvdb_grid(const InputFile& file, const NvdbGrid& grid, std::span<std::byte> to);

}  // namespace wrinkle::io
