#pragma once

#include <filesystem>
#include <vector>

namespace wrinkle::io {

/// One image of a texture that is split into tiles: rock.<UDIM>.exr stands for rock.1001.exr, which covers the unit
/// square of texture coordinates, 1002 the one right of it, 1011 the one above.
struct UdimTile {
    std::filesystem::path file;
    int column = 0, row = 0;  ///< of unit squares, from the origin; row 0 is the lowest
};

/// The tiles of a file name with <UDIM> that exist. Empty when there are none, or the name is an ordinary one.
std::vector<UdimTile> udim_tiles(const std::filesystem::path& pattern);
bool is_udim(const std::filesystem::path& file);

/// How many unit squares the tiles span, from the origin.
struct UdimSpan {
    int columns = 1, rows = 1;
};
UdimSpan udim_span(const std::vector<UdimTile>& tiles);

}  // namespace wrinkle::io
