#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace wrinkle::io {

/// Packs blocks of bytes as zlib streams, each with the quickest of three compressors that makes it hardly larger than
/// zlib's level 4, which is OpenEXR's, would: ISA-L's level 3 where two samples of the block lose at most a hundredth
/// by it, as those of rendered or bumped floats do; else libdeflate's level 1 where they hardly pack, else its level 4.
/// Files of frames grow by at most 3% (deflate_test).
///
/// Which one it is depends on the block alone, so that a file does not depend on threads. ISA-L has other code for
/// other processors: the packed bytes may differ between them, what they hold does not.
class Deflater {
public:
    Deflater();
    ~Deflater();

    /// How many bytes of `out` the packed block takes; 0 when it does not fit.
    std::size_t pack(std::span<const std::uint8_t> block, std::span<std::uint8_t> out);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle::io
