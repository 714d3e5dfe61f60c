#pragma once

#include <OpenImageIO/imageio.h>

#include <functional>
#include <string>

#include "io/texture_file.h"

/// What texels mean, wherever they are from.
namespace wrinkle {

/// Texels to be read: of a file, or of memory.
struct TexelSource {
    OIIO::ImageSpec spec;              ///< as the file says; of memory: size, channels, float
    std::string name;                  ///< for messages
    std::function<Image(int)> read{};  ///< gives so many channels of them, from the first on, bottom row first
};

/// What load_texture, load_slopes and load_bump say of files.
Image texture_of(const TexelSource& source, ImageUse use);
Image slopes_of(const TexelSource& source, Encoding encoding, SlopeUnit unit);
Image bump_of(const TexelSource& source, const TextureUse& use);

}  // namespace wrinkle
