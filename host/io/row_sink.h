#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace wrinkle::io {

/// Rows of a picture, channel by channel; rows of a channel begin `stride` floats after each other.
struct PlaneRows {
    std::span<const float* const> planes;
    std::size_t stride = 0;
    std::uint32_t count = 0;

    const float* row(std::size_t channel, std::uint32_t y) const { return planes[channel] + y * stride; }
};

/// A picture in a format that is written row by row.
class RowSink {
public:
    virtual ~RowSink() = default;

    /// The next rows. False where they could not be written: failure() or the format's own message says why.
    virtual bool write(const PlaneRows& rows) = 0;
    /// All rows are there.
    virtual bool finish() = 0;
};

}  // namespace wrinkle::io
