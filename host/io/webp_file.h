#pragma once

#include "base/input_file.h"
#include "io/texture_file.h"

namespace wrinkle::io {

/// The first `channels` of red, green, blue and alpha of a WebP image, as it stores them, in [0,1] and the bottom row
/// first. For images with alpha: OpenImageIO multiplies them by it, in 8 bits, whatever it is asked for. Throws Error
/// when the file is damaged, or moves.
Image read_webp(const InputFile& file, int channels);

}  // namespace wrinkle::io
