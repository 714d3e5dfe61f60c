#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

namespace wrinkle::io {

/// A channel as its part names it, and where its pixels go.
struct BlockChannel {
    std::string_view name;
    float* out;  ///< the first pixel; unsigned integers are stored as their bits
};

/// Reads ZIP-compressed scanlines of an EXR file faster than OpenEXR 3.1 does: it inflates with libdeflate instead of
/// zlib, and undoes the predictor only for the channels that are wanted (a block holds all channels of its rows). Files
/// of other kinds are left to OpenImageIO.
class ZipBlocks {
public:
    /// `file` must be one that OpenImageIO could open.
    explicit ZipBlocks(const std::filesystem::path& file);
    ~ZipBlocks();
    ZipBlocks(const ZipBlocks&) = delete;
    ZipBlocks& operator=(const ZipBlocks&) = delete;

    /// Reads rows [y_begin, y_end), counted from the top of the data window. They must be whole blocks, the last of
    /// which may be cut by the end of the part. Pixels are `stride` floats apart; rows follow each other without a gap.
    /// Returns false when the part is of another kind (tiled, compressed otherwise, subsampled) or a block is damaged;
    /// some pixels may then have been written.
    bool read(int part, std::span<const BlockChannel> channels, int y_begin, int y_end, std::size_t stride);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle::io
