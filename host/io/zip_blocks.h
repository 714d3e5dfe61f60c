#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "base/input_file.h"
#include "io/image_parts.h"

namespace wrinkle::io {

/// A channel as its part names it, what OpenImageIO says of its numbers, and where they go.
struct BlockChannel {
    std::string_view name;
    std::span<float> out;  ///< begins with its first pixel; unsigned integers are stored as their bits
    bool whole_numbers = false, half = false;
};

/// Reads ZIP-compressed scanlines of an EXR file faster than OpenEXR 3.1 does: it inflates with libdeflate instead of
/// zlib, and undoes the predictor only for the channels that are wanted (a block holds all channels of its rows). Files
/// of other kinds are left to OpenImageIO.
///
/// The header is parsed by OpenEXRCore here, and was by OpenEXR for OpenImageIO. Where the two disagree about what is
/// in a part, that part is left to OpenImageIO as well, since sizes of one are no bounds for the other.
class ZipBlocks {
public:
    /// `parts` is what OpenImageIO says of them.
    ZipBlocks(std::shared_ptr<const InputFile> file, std::span<const Part> parts);
    ~ZipBlocks();
    ZipBlocks(const ZipBlocks&) = delete;
    ZipBlocks& operator=(const ZipBlocks&) = delete;

    /// Reads rows [y_begin, y_end), counted from the top of the data window. They must be whole blocks, the last of
    /// which may be cut by the end of the part. Pixels are `stride` floats apart; rows follow each other without a gap.
    /// Returns false when the part is of another kind (tiled, compressed otherwise, subsampled), a destination is too
    /// small, or a block is damaged; some pixels may then have been written.
    bool read(int part, std::span<const BlockChannel> channels, int y_begin, int y_end, std::size_t stride);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle::io
