#pragma once

#include <string_view>

#include "base/input_file.h"

namespace wrinkle::io {

/// OpenImageIO's name of the format that a file has by its first bytes, whatever its name; empty when it is none of
/// kImageFormats.
std::string_view image_format(const InputFile& file);

/// Those that are read. OpenImageIO knows more, which it can only open by name, and some of them run whole video or
/// medical libraries over whatever a file holds.
inline constexpr std::string_view kImageFormats =
    "EXR, TIFF, PNG, JPEG, HDR, PNM, DPX, TGA, BMP, PSD, DDS, WebP or JPEG 2000";

}  // namespace wrinkle::io
