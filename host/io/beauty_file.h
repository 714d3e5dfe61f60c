#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "io/band_reader.h"
#include "io/image_parts.h"

namespace wrinkle::io {

/// Throws Error where several layers of a file are called as pictures are, and nothing says which is meant.
void require_one_beauty(std::span<const std::string> channels, const std::string& file);

/// The pixels of a frame along each side of a pixel of its beauty. Throws Error unless that is a whole number.
std::uint32_t beauty_scale(const ImageParts& beauty, const std::filesystem::path& beauty_file, const ImageParts& frame,
                           const std::filesystem::path& frame_file);

/// Reads rows [row_begin, row_end) of `width` pixels from a file that has one pixel where these have `scale` along each
/// side.
void read_enlarged(BandReader& reader, std::uint32_t row_begin, std::uint32_t row_end,
                   std::span<const WantedChannel> channels, std::size_t width, std::uint32_t scale);

/// Whether a channel is the alpha beside the colours that `red` is one of.
bool is_alpha_beside(const std::string& channel, const std::string& red);

}  // namespace wrinkle::io
