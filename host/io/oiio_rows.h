#pragma once

#include <OpenImageIO/imageio.h>

#include <functional>
#include <vector>

#include "io/row_sink.h"

namespace wrinkle::io {

/// Hands rows to OpenImageIO, for what few want: lossy EXR files, and PNGs with an alpha channel.
class OiioRows : public RowSink {
public:
    /// What a channel's values become before they are stored.
    using Encode = std::function<float(float value, std::size_t channel)>;

    /// `output` is open; `whole` says which channels hold the bits of integers.
    OiioRows(OIIO::ImageOutput& output, std::vector<bool> whole, Encode encode);
    ~OiioRows() override;

    bool write(const PlaneRows& rows) override;
    bool finish() override;

private:
    const void* native(std::size_t pixels);

    OIIO::ImageOutput& output_;
    const OIIO::ImageSpec spec_;
    const std::vector<bool> whole_;
    const bool integers_;
    const Encode encode_;
    int next_row_;
    std::vector<float> scratch_;
    std::vector<std::byte> packed_;
};

}  // namespace wrinkle::io
