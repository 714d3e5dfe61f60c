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
    float* out;  ///< the first pixel; of unsigned integers the bits
};

/// Reads the ZIP blocks of an EXR file's scanlines faster than OpenEXR 3.1 does: inflates with libdeflate instead of
/// zlib, and undoes the predictor only where a wanted channel lies (a block holds all channels of its rows).
/// What it does not know it leaves to OpenImageIO.
class ZipBlocks {
public:
    /// Of a file that OpenImageIO could open.
    explicit ZipBlocks(const std::filesystem::path& file);
    ~ZipBlocks();
    ZipBlocks(const ZipBlocks&) = delete;
    ZipBlocks& operator=(const ZipBlocks&) = delete;

    /// Data rows [y_begin, y_end), counted from the data window's top; they begin and end with a block, or at the
    /// part's end. Pixels are `stride` floats apart, rows follow each other. False, with some pixels written, where the
    /// part is of another kind (tiled, otherwise compressed, subsampled) or a block is damaged.
    bool read(int part, std::span<const BlockChannel> channels, int y_begin, int y_end, std::size_t stride);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle::io
