#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "io/image_parts.h"
#include "io/zip_blocks.h"

namespace wrinkle::io {

/// A channel and where its rows go.
struct WantedChannel {
    ChannelPlace place;
    float* out;  ///< rows of the frame's width
};

/// Reads bands of rows of some channels: one read per part over the narrowest range of channels, then apart into
/// planes. A ZIP block holds all channels of its rows, and decompressing it is most of the work: the last blocks are
/// kept for a band that begins among them.
class BandReader {
public:
    BandReader(std::unique_ptr<OIIO::ImageInput> input, std::filesystem::path file, Size size, std::vector<Part> parts);

    /// Rows [row_begin, row_end) of the frame. Throws Error naming the first row that cannot be read.
    void read(std::uint32_t row_begin, std::uint32_t row_end, std::span<const WantedChannel> wanted);

private:
    struct Range;

    /// The last blocks of a range, as they lay in the scratch.
    struct Held {
        std::vector<int> channels;  ///< others of the range may be missing
        int first = 0, last = 0;    ///< data rows
        std::vector<float> rows;
    };

    void read_range(const Range& range, std::uint32_t row_begin, std::uint32_t row_end);
    /// Brings data rows [y, y_end) and the rest of their blocks into the scratch; returns the row that it begins with.
    int fetch(const Range& range, int y, int y_end);
    /// False where they have to be read the slower way.
    bool read_zip_blocks(const Range& range, int y_begin, int y_end, float* out);
    bool read_interleaved(OIIO::ImageInput& input, const Range& range, int y_begin, int y_end, float* out);
    [[noreturn]] void fail(const Range& range, int y_begin, int y_end);

    std::unique_ptr<OIIO::ImageInput> input_;
    std::filesystem::path file_;
    ZipBlocks zip_blocks_;
    Size size_;
    std::vector<Part> parts_;
    std::vector<float> scratch_;                 ///< interleaved rows; kept, since fresh pages cost as much as the copy
    std::map<std::pair<int, bool>, Held> held_;  ///< by part and whether numbers are whole
};

}  // namespace wrinkle::io
