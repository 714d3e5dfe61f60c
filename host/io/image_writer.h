#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/metadata.h"
#include "wrinkle/camera.h"

namespace wrinkle {

enum class PngEncoding {
    srgb,    ///< linear light: times 2^exposure, then the sRGB curve
    linear,  ///< value in [0,1] as it is
    normal,  ///< (n + 1) / 2, no curve
};

/// What a PNG holds for a value, in [0,1]; NaN is 0. `factor` is 2^exposure.
float png_value(float value, PngEncoding encoding, float factor);

struct ImageOptions {
    bool half = false;  ///< EXR: 16-bit floats, finite values kept finite; cryptomatte channels stay 32-bit ...
    std::set<std::string> full;  ///< ... and so do these
    Metadata metadata;           ///< EXR: header attributes; those that describe the old file's storage are left out
    PngEncoding png = PngEncoding::srgb;
    double exposure = 0;  ///< stops; PngEncoding::srgb
};

/// Writes a picture band by band and all or nothing: until finish() returns nothing can be seen under the name, and an
/// older file stays as it is. The extension chooses the format: .exr (ZIP scanlines) or .png (8 bit, 1 to 4 channels).
class ImageWriter {
public:
    /// Throws Error when the folder is missing or not writable, or the extension is neither .exr nor .png.
    ImageWriter(const std::filesystem::path& file, Size size, std::vector<std::string> channels,
                ImageOptions options = {});
    ~ImageWriter();  ///< without finish(): nothing is left behind
    ImageWriter(ImageWriter&&) noexcept;
    ImageWriter& operator=(ImageWriter&&) noexcept;

    /// Rows [row_begin, row_end) from the top, one plane of (row_end - row_begin) * width floats a channel. Bands come
    /// in order, without gaps. Throws Error when the disk is full.
    void write_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const float* const> planes);

    /// Writes what is left, so that finish() has only to put the file in place: of several files, all or none.
    void complete();

    /// Puts the file in place, synced to disk. Throws Error when rows are missing or the disk is full.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle
