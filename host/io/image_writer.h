#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/frame_window.h"
#include "io/metadata.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

enum class PngEncoding {
    srgb,    ///< for linear light: multiplied by 2^exposure, then the sRGB curve
    linear,  ///< for values in [0,1], which are written as they are
    normal,  ///< for normals: (n + 1) / 2, without a curve
};

/// The number in [0,1] that a PNG holds for a value; 0 for NaN. `factor` is 2^exposure.
float png_value(float value, PngEncoding encoding, float factor);

struct ImageOptions {
    bool half = false;           ///< EXR: 16-bit floats; finite values stay finite, cryptomatte channels stay 32-bit
    std::set<std::string> full;  ///< further channels that stay 32-bit
    std::set<std::string>
        whole{};  ///< EXR: channels whose floats hold the bits of unsigned integers, to be stored as such
    Compression compression = Compression::zip;  ///< EXR
    /// Where the pixels lie; nothing: they are the picture. EXR files hold all of them, PNG the display window.
    std::optional<FrameWindow> window{};
    Metadata metadata;         ///< EXR: attributes for the header; those that say how a file is stored are left out
    std::string provenance{};  ///< a hash of all that goes into the picture (io/provenance.h); empty: none is written
    PngEncoding png = PngEncoding::srgb;
    int png_bits = 8;     ///< of a channel: 8 or 16
    double exposure = 0;  ///< stops; PngEncoding::srgb
};

/// Writes a picture band by band. It appears under its name only when finish() returns; until then an older file of
/// that name stays as it is. The extension chooses the format: .exr (scanlines) or .png (8 or 16 bits, 1 to 4
/// channels).
class ImageWriter {
public:
    /// Throws Error when the folder is missing or not writable, or the extension is neither .exr nor .png.
    ImageWriter(const std::filesystem::path& file, Size size, std::vector<std::string> channels,
                ImageOptions options = {});
    ~ImageWriter();  ///< without finish(): nothing is left behind
    ImageWriter(ImageWriter&&) noexcept;
    ImageWriter& operator=(ImageWriter&&) noexcept;

    /// Writes rows [row_begin, row_end), counted from the top; `planes` has (row_end - row_begin) * width floats for
    /// each channel. Bands must come in order, without gaps. Throws Error when the disk is full.
    void write_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const float* const> planes);

    /// Writes everything to disk, so that finish() only has to put the file in place. Who writes several files
    /// completes all of them before finishing the first, so that either all or none appear.
    void complete();

    /// Puts the file in place, synced to disk. Throws Error when rows are missing or the disk is full.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle
