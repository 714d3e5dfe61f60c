#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

/// Texels with t up: row 0 is the bottom of the picture. Channels interleaved.
struct Image {
    int width = 0, height = 0, channels = 0;
    std::vector<float> texels;

    float at(int x, int y, int channel) const {
        return texels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                          static_cast<std::size_t>(channels) +
                      static_cast<std::size_t>(channel)];
    }
};

enum class ImageUse {
    scalar,         ///< height or mask: the first of 1 or 3 and more channels; the image has 1
    normal,         ///< tangent normal, 3 channels in [0,1]: m = 2 texel - 1
    object_normal,  ///< object- or world-space normal, 3 channels, as vectors
};

/// Loads a texture. Integer formats become [0,1] whatever their bits, float stays as it is; no colour conversion.
///
/// Normals: of two channels (x, y) the third becomes sqrt(1 - x^2 - y^2) [Mik20 eq. 16]; a float file that holds signed
/// components (some x or y below 0) is brought to [0,1], so the caller always unpacks the same way.
///
/// Object-space normals: integer formats, and float files whose vectors are unit only then, hold (v + 1) / 2. In
/// integer formats what is shorter than 1/8 is no normal but the grey between the charts of a bake: 0.
///
/// Throws Error when the file is missing, empty, damaged, has the wrong number of channels, or a NaN or Inf texel.
Image load_texture(const std::filesystem::path& file, ImageUse use);

/// Loads slopes: 2 channels, dh/ds and dh/dt per unit of texture coordinate, t up. `maketx --bumpslopes` files are
/// known by their channels b1_dhds and b2_dhdt, and say themselves what their slopes are per; of others the first two
/// channels are read as `encoding` and `unit` say. Throws as load_texture does, and for a file of `maketx --bumpslopes`
/// where slopes are wanted in metres over metres.
Image load_slopes(const std::filesystem::path& file, Encoding encoding, SlopeUnit unit);

/// The image of a texture by its content.
Image load_bump(const TextureUse& use);

}  // namespace wrinkle
