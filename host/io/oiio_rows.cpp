#include "io/oiio_rows.h"

#include <OpenImageIO/parallel.h>
#include <half.h>

#include <algorithm>

namespace wrinkle::io {

OiioRows::OiioRows(OIIO::ImageOutput& output, std::vector<bool> whole, Encode encode)
    : output_(output),
      spec_(output.spec()),
      whole_(std::move(whole)),
      integers_(std::ranges::find(whole_, true) != whole_.end()),
      encode_(std::move(encode)),
      next_row_(spec_.y) {}

OiioRows::~OiioRows() {
    if (output_.format_name() != std::string_view("png")) return;
    const std::vector<float> blank(static_cast<std::size_t>(spec_.width * spec_.nchannels));
    for (; next_row_ < spec_.y + spec_.height; ++next_row_)  // libpng prints a complaint about missing rows
        output_.write_scanline(next_row_, 0, OIIO::TypeFloat, blank.data());
}

bool OiioRows::write(const PlaneRows& rows) {
    const auto width = static_cast<std::size_t>(spec_.width), channels = whole_.size();
    scratch_.resize(std::max(scratch_.size(), rows.count * width * channels));
    OIIO::parallel_for(std::int64_t{0}, std::int64_t{rows.count}, [&](std::int64_t y) {
        for (std::size_t c = 0; c < channels; ++c) {
            const float* in = rows.row(c, static_cast<std::uint32_t>(y));
            float* out = scratch_.data() + static_cast<std::size_t>(y) * width * channels + c;
            for (std::size_t x = 0; x < width; ++x) out[x * channels] = encode_(in[x], c);
        }
    });
    const int first = next_row_, end = first + static_cast<int>(rows.count);
    next_row_ = end;
    return output_.write_scanlines(first, end, 0, integers_ ? OIIO::TypeUnknown : OIIO::TypeFloat,
                                   integers_ ? native(rows.count * width) : scratch_.data());
}

/// The interleaved floats as the file stores them, where integers are among them: those are bits already.
const void* OiioRows::native(std::size_t pixels) {
    packed_.clear();
    const auto append = [&](const auto& value) {
        const auto* bytes = reinterpret_cast<const std::byte*>(&value);
        packed_.insert(packed_.end(), bytes, bytes + sizeof value);
    };
    const std::size_t channels = whole_.size();
    for (std::size_t i = 0; i < pixels * channels; ++i)
        if (spec_.channelformat(static_cast<int>(i % channels)) == OIIO::TypeHalf)
            append(half(scratch_[i]));
        else
            append(scratch_[i]);
    return packed_.data();
}

bool OiioRows::finish() { return output_.close(); }

}  // namespace wrinkle::io
