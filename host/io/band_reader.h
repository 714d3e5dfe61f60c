#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "io/image_parts.h"

namespace wrinkle::io {

/// A channel and where its rows go.
struct WantedChannel {
    ChannelPlace place;
    float* out;  ///< rows of the frame's width
};

/// Reads bands of rows of some channels: one read per part over the narrowest range of channels, then apart into
/// planes. (A ZIP block holds all channels, so a second read would decompress everything again.)
class BandReader {
public:
    BandReader(std::unique_ptr<OIIO::ImageInput> input, std::filesystem::path file, Size size, std::vector<Part> parts);

    /// Rows [row_begin, row_end) of the frame. Throws Error naming the first row that cannot be read.
    void read(std::uint32_t row_begin, std::uint32_t row_end, std::span<const WantedChannel> wanted);

private:
    struct Range;
    void read_range(const Range& range, std::uint32_t row_begin, std::uint32_t row_end);
    bool read_interleaved(OIIO::ImageInput& input, const Range& range, int y_begin, int y_end);
    [[noreturn]] void fail(const Range& range, int y_begin, int y_end);

    std::unique_ptr<OIIO::ImageInput> input_;
    std::filesystem::path file_;
    Size size_;
    std::vector<Part> parts_;
    std::vector<float> scratch_;  ///< interleaved rows; kept, since fresh pages cost as much as the copy
};

}  // namespace wrinkle::io
