#include "io/band_reader.h"

#include <OpenImageIO/parallel.h>

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "io/image_open.h"
#include "io/reason.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

constexpr int zip_block = 16;                      // rows; a band that begins inside a block decompresses it twice
constexpr std::size_t scratch_floats = 16u << 20;  // 64 MiB: enough blocks for every core, small beside a frame

int round_down(int value, int step) { return value - value % step; }

}  // namespace

/// Channels [begin, end) of one part, read as one type.
struct BandReader::Range {
    int part = 0, begin = 0, end = 0;
    bool whole_numbers = false;
    std::vector<WantedChannel> wanted;

    std::size_t channels() const { return static_cast<std::size_t>(end - begin); }
};

BandReader::BandReader(std::unique_ptr<OIIO::ImageInput> input, std::filesystem::path file, Size size,
                       std::vector<Part> parts)
    : input_(std::move(input)), file_(std::move(file)), size_(size), parts_(std::move(parts)) {}

void BandReader::read(std::uint32_t row_begin, std::uint32_t row_end, std::span<const WantedChannel> wanted) {
    std::map<std::pair<int, bool>, Range> ranges;
    for (const auto& channel : wanted) {
        const auto& place = channel.place;
        auto& range = ranges[{place.part, place.whole_numbers}];
        const bool first = range.wanted.empty();
        range.part = place.part;
        range.whole_numbers = place.whole_numbers;
        range.begin = first ? place.index : std::min(range.begin, place.index);
        range.end = first ? place.index + 1 : std::max(range.end, place.index + 1);
        range.wanted.push_back(channel);
    }
    for (const auto& [key, range] : ranges) read_range(range, row_begin, row_end);
}

void BandReader::read_range(const Range& range, std::uint32_t row_begin, std::uint32_t row_end) {
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const int width = static_cast<int>(size_.width);
    const int left = std::max(part.x, 0), right = std::min(part.x + part.width, width);
    const int top = std::clamp(part.y, static_cast<int>(row_begin), static_cast<int>(row_end));
    const int bottom = std::clamp(part.y + part.height, top, static_cast<int>(row_end));
    if (left > 0 || right < width || top > static_cast<int>(row_begin) || bottom < static_cast<int>(row_end)) {
        for (const auto& channel : range.wanted) {
            std::fill_n(channel.out, std::size_t{row_end - row_begin} * size_.width, 0.0f);
        }
    }
    if (right <= left) return;

    const std::size_t row_floats = range.channels() * static_cast<std::size_t>(part.width);
    const int step = part.tile_height > 0 ? part.tile_height : zip_block;
    const int rows = std::max(round_down(static_cast<int>(scratch_floats / row_floats), step), step);
    // Data rows are counted from the data window's top, where blocks and tiles begin.
    for (int y = top - part.y; y < bottom - part.y;) {
        const int y_end = std::min(round_down(y, step) + rows, bottom - part.y);
        const int read_begin = part.tile_height > 0 ? round_down(y, step) : y;
        const int read_end = part.tile_height > 0 ? std::min(round_down(y_end + step - 1, step), part.height) : y_end;
        scratch_.resize(std::max(scratch_.size(), row_floats * static_cast<std::size_t>(read_end - read_begin)));
        if (!read_interleaved(*input_, range, read_begin, read_end)) fail(range, read_begin, read_end);
        const auto separate = [&](std::int64_t from, std::int64_t to) {
            for (auto row = from; row < to; ++row) {
                const float* in = scratch_.data() + row_floats * static_cast<std::size_t>(row - read_begin) +
                                  range.channels() * static_cast<std::size_t>(left - part.x);
                const auto frame_row = static_cast<std::size_t>(row + part.y) - row_begin;
                for (const auto& channel : range.wanted) {
                    const float* from_channel = in + (channel.place.index - range.begin);
                    float* out = channel.out + frame_row * size_.width;
                    for (int x = left; x < right; ++x, from_channel += range.channels()) {
                        // Read as uint32_t the four bytes are the number itself.
                        out[x] = range.whole_numbers ? static_cast<float>(std::bit_cast<std::uint32_t>(*from_channel))
                                                     : *from_channel;
                    }
                }
            }
        };
        OIIO::parallel_for_chunked(y, y_end, zip_block, separate);
        y = y_end;
    }
}

bool BandReader::read_interleaved(OIIO::ImageInput& input, const Range& range, int y_begin, int y_end) {
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const auto type = range.whole_numbers ? OIIO::TypeUInt32 : OIIO::TypeFloat;
    const int from = part.origin_y + y_begin, to = part.origin_y + y_end;
    if (part.tile_height > 0) {
        return input.read_tiles(range.part, 0, part.origin_x, part.origin_x + part.width, from, to, 0, 1, range.begin,
                                range.end, type, scratch_.data());
    }
    return input.read_scanlines(range.part, 0, from, to, 0, range.begin, range.end, type, scratch_.data());
}

void BandReader::fail(const Range& range, int y_begin, int y_end) {
    const auto why = reason(input_->geterror());
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const int step = part.tile_height > 0 ? part.tile_height : 1;
    const auto again = open_image(file_);  // after a failure the first stream stays at its end
    int bad = y_begin;
    while (bad + step < y_end && read_interleaved(*again, range, bad, bad + step)) bad += step;
    again->geterror();
    throw Error(fmt::format("{}: row {} of {} cannot be read{}: the file is truncated or damaged; render it again",
                            file_.string(), bad + part.y, size_.height, why));
}

}  // namespace wrinkle::io
