#pragma once

#include <memory>

#include "io/descriptor_proxy.h"
#include "io/image_writer.h"
#include "io/row_sink.h"

namespace wrinkle::io {

/// A PNG of 1 or 3 channels, whose rows are encoded and deflated on all cores; libpng does so on one.
class PngRows : public RowSink {
public:
    /// Begins the file. Of `options` it takes what concerns PNGs, and the provenance.
    PngRows(DescriptorProxy& file, Size size, std::size_t channels, const ImageOptions& options);
    ~PngRows() override;

    bool write(const PlaneRows& rows) override;
    bool finish() override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle::io
