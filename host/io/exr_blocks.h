#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/descriptor_proxy.h"
#include "io/row_sink.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle::io {

/// How a channel of a scanline file stores its numbers. Whole ones are floats that hold the integers' bits.
struct BlockPlane {
    std::string name;
    bool half = false;  ///< finite values stay finite
};

/// Writes the pixels of an EXR file, once its header and an empty table of offsets are there: blocks of rows, packed
/// on all cores (deflate.h), which OpenEXR 3.1 leaves to zlib at less than half the speed.
///
/// A row that does not fill its block waits for the next ones.
class ExrBlocks : public RowSink {
public:
    /// `top`: the number of the first row. `compression` is zip, zips or none.
    ExrBlocks(DescriptorProxy& file, int top, Size size, std::vector<BlockPlane> planes, Compression compression);
    ~ExrBlocks() override;

    bool write(const PlaneRows& rows) override;
    bool finish() override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle::io
