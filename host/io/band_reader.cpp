#include "io/band_reader.h"

#include <OpenImageIO/parallel.h>

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "base/only_errors.h"
#include "io/reason.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

constexpr int zip_block = 16;  // rows; reads cover whole blocks, since ZIP decompresses whole blocks anyway
constexpr int overlap = 2;     // rows that two bands may share, as neighbours of each other; matters for speed only
constexpr std::size_t scratch_floats = 16u << 20;  // 64 MiB: enough blocks for every core, small beside a frame

int round_down(int value, int step) { return value - value % step; }

int block_rows(const Part& part) { return part.tile_height > 0 ? part.tile_height : zip_block; }

}  // namespace

/// Channels [begin, end) of one part, which are read together, as numbers of one type.
struct BandReader::Range {
    int part = 0, begin = 0, end = 0;
    bool whole_numbers = false;
    std::vector<WantedChannel> wanted;

    std::size_t channels() const { return static_cast<std::size_t>(end - begin); }
    std::vector<int> wanted_indices() const {
        std::vector<int> indices;
        for (const auto& channel : wanted) indices.push_back(channel.place.index);
        return indices;
    }
};

BandReader::BandReader(OpenImage image, const ImageParts& what)
    : image_(std::move(image)),
      size_(what.size),
      parts_(what.parts),
      channels_(what.channels),
      zip_blocks_(image_.file(), parts_) {}

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
    only_errors(image_.file()->path().c_str(), [&] {
        for (const auto& [key, range] : ranges) read_range(range, row_begin, row_end);
    });
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
    const int step = block_rows(part);
    const int rows = std::max(round_down(static_cast<int>(scratch_floats / row_floats), step), step);
    // From here on rows are counted from the top of the data window, where the first block or tile begins.
    for (int y = top - part.y; y < bottom - part.y;) {
        const int y_end = std::min(round_down(y, step) + rows, bottom - part.y);
        const int first = glance(range, y, y_end) ? y : fetch(range, y, y_end);
        const auto separate = [&](std::int64_t from, std::int64_t to) {
            for (auto row = from; row < to; ++row) {
                const float* in = scratch_.data() + row_floats * static_cast<std::size_t>(row - first) +
                                  range.channels() * static_cast<std::size_t>(left - part.x);
                const auto frame_row = static_cast<std::size_t>(row + part.y) - row_begin;
                for (const auto& channel : range.wanted) {
                    const float* from_channel = in + (channel.place.index - range.begin);
                    float* out = channel.out + frame_row * size_.width;
                    for (int x = left; x < right; ++x, from_channel += range.channels()) {
                        // Whole numbers were read as uint32_t into the same four bytes.
                        out[x] = range.whole_numbers && !channel.bits
                                     ? static_cast<float>(std::bit_cast<std::uint32_t>(*from_channel))
                                     : *from_channel;
                    }
                }
            }
        };
        OIIO::parallel_for_chunked(y, y_end, zip_block, separate);
        y = y_end;
    }
}

int BandReader::fetch(const Range& range, int y, int y_end) {
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const std::size_t row_floats = range.channels() * static_cast<std::size_t>(part.width);
    const int step = block_rows(part), end = std::min(round_down(y_end + step - 1, step), part.height);
    Held& held = held_[{range.part, range.whole_numbers}];
    const bool follows = held.channels == range.wanted_indices() && held.first <= y && y < held.last;
    const int first = follows ? held.first : round_down(y, step);
    const int read_from = follows ? held.last : first, last = std::max(read_from, end);
    scratch_.resize(std::max(scratch_.size(), row_floats * static_cast<std::size_t>(last - first)));
    if (follows) std::ranges::copy(held.rows, scratch_.begin());
    const auto row = [&](int y_of) { return scratch_.data() + row_floats * static_cast<std::size_t>(y_of - first); };
    const std::span<float> out(row(read_from), row(last));
    if (read_from < end && !read_rows(range, read_from, end, out)) fail(range, read_from, end);
    const int keep = std::max(first, round_down(std::max(y_end - overlap, 0), step));
    if (row_floats * static_cast<std::size_t>(last - keep) > scratch_floats)  // tall tiles are read again instead
        held = {};
    else
        held = {range.wanted_indices(), keep, last, {row(keep), row(last)}};
    return first;
}

bool BandReader::glance(const Range& range, int y, int y_end) {
    constexpr int few = 16;  // rows
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const int first = round_down(y, part.block_rows), end = std::min(first + part.block_rows, part.height);
    if (range.whole_numbers || y_end > end) return false;
    const auto width = static_cast<std::size_t>(part.width), channels = static_cast<std::size_t>(part.channels);
    std::span<const float> block = kept_.find(range.part, first);
    if (block.empty()) {
        const std::size_t floats = width * channels * static_cast<std::size_t>(end - first);
        if (y_end - y > few) kept_.clear();  // the frame itself is read now
        if (y_end - y > few || !kept_.has_room(floats)) return false;
        Range all{range.part, 0, part.channels, false, {}};
        for (const ChannelPlace& place : channels_)
            if (place.part == range.part) all.wanted.push_back({place, nullptr});
        std::vector<float> read(floats);
        if (!read_rows(all, first, end, read)) return false;  // fetching fails again, and tells which row
        block = kept_.keep(range.part, first, std::move(read));
    }
    scratch_.resize(std::max(scratch_.size(), range.channels() * width * static_cast<std::size_t>(y_end - y)));
    const float* from = block.data() + width * channels * static_cast<std::size_t>(y - first);
    float* to = scratch_.data();
    for (std::size_t pixel = 0; pixel < width * static_cast<std::size_t>(y_end - y); ++pixel, from += channels)
        to = std::copy(from + range.begin, from + range.end, to);
    return true;
}

bool BandReader::read_rows(const Range& range, int y_begin, int y_end, std::span<float> out) {
    return read_zip_blocks(range, y_begin, y_end, out) || read_interleaved(image_.input(), range, y_begin, y_end, out);
}

bool BandReader::read_zip_blocks(const Range& range, int y_begin, int y_end, std::span<float> out) {
    std::vector<BlockChannel> channels;
    for (const auto& channel : range.wanted) {
        const ChannelPlace& place = channel.place;
        channels.push_back({place.stored_name, out.subspan(static_cast<std::size_t>(place.index - range.begin)),
                            place.whole_numbers, place.half});
    }
    return zip_blocks_.read(range.part, channels, y_begin, y_end, range.channels());
}

bool BandReader::read_interleaved(OIIO::ImageInput& input, const Range& range, int y_begin, int y_end,
                                  std::span<float> out) {
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const auto type = range.whole_numbers ? OIIO::TypeUInt32 : OIIO::TypeFloat;
    const int from = part.origin_y + y_begin, to = part.origin_y + y_end;
    if (part.tile_height > 0) {
        return input.read_tiles(range.part, 0, part.origin_x, part.origin_x + part.width, from, to, 0, 1, range.begin,
                                range.end, type, out.data());
    }
    return input.read_scanlines(range.part, 0, from, to, 0, range.begin, range.end, type, out.data());
}

void BandReader::fail(const Range& range, int y_begin, int y_end) {
    const auto why = reason(image_.input().geterror());
    const auto& part = parts_[static_cast<std::size_t>(range.part)];
    const int step = part.tile_height > 0 ? part.tile_height : 1;
    const auto again = image_.again();
    int bad = y_begin;
    while (bad + step < y_end && read_interleaved(again.input(), range, bad, bad + step, scratch_)) bad += step;
    again.input().geterror();
    throw Error(fmt::format("{}: row {} of {} cannot be read{}: the file is truncated or damaged; render it again",
                            image_.file()->name(), bad + part.y, size_.height, why));
}

}  // namespace wrinkle::io
