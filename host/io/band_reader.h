#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "io/image_open.h"
#include "io/image_parts.h"
#include "io/kept_blocks.h"
#include "io/zip_blocks.h"

namespace wrinkle::io {

/// A channel to read, and where to.
struct WantedChannel {
    ChannelPlace place;
    float* out;         ///< rows of the frame's width
    bool bits = false;  ///< whole numbers come as their bits, not as the nearest floats
};

/// Reads some channels of a frame, a band of rows at a time. Each part of the file is read once, from the first to the
/// last of the wanted channels, and then separated into planes. Decompressing ZIP blocks is most of the work. A block
/// may belong to two bands, so the last ones of a band are kept for the next; and those that a glance at a few rows
/// took are kept for the next glance.
class BandReader {
public:
    BandReader(OpenImage image, const ImageParts& what);

    void read_ahead() const { image_.file()->read_ahead(); }

    /// Rows [row_begin, row_end) of the frame. Throws Error naming the first row that cannot be read.
    void read(std::uint32_t row_begin, std::uint32_t row_end, std::span<const WantedChannel> wanted);

private:
    struct Range;

    /// The last blocks of a band, for the next one; a copy of a part of the scratch memory.
    struct Held {
        std::vector<int> channels;  ///< only these were read; other channels of the range may hold anything
        int first = 0, last = 0;    ///< rows [first, last) of the data window
        std::vector<float> rows;
    };

    void read_range(const Range& range, std::uint32_t row_begin, std::uint32_t row_end);
    /// Brings rows [y, y_end) of the data window into the scratch memory, with the rest of their blocks. Returns the
    /// row that the scratch memory begins with.
    int fetch(const Range& range, int y, int y_end);
    /// Puts rows [y, y_end) into the scratch memory if they lie in a block that is kept. If they are few, as for a
    /// quick look at the frame, it first decompresses their block and keeps it, where there is room. Returns false for
    /// all other rows, which have to be fetched.
    bool glance(const Range& range, int y, int y_end);
    /// Fast where ZIP blocks allow it, else by OpenImageIO.
    bool read_rows(const Range& range, int y_begin, int y_end, std::span<float> out);
    bool read_zip_blocks(const Range& range, int y_begin, int y_end, std::span<float> out);
    bool read_interleaved(OIIO::ImageInput& input, const Range& range, int y_begin, int y_end, std::span<float> out);
    [[noreturn]] void fail(const Range& range, int y_begin, int y_end);

    OpenImage image_;
    Size size_;
    std::vector<Part> parts_;
    std::vector<ChannelPlace> channels_;
    ZipBlocks zip_blocks_;
    KeptBlocks kept_;
    std::vector<float> scratch_;  ///< interleaved rows; reused, as touching fresh memory costs as much as the copy
    std::map<std::pair<int, bool>, Held> held_;  ///< by number of the part, and whether its numbers are whole ones
};

}  // namespace wrinkle::io
