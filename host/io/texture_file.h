#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

/// Texels, with t pointing up: row 0 is the bottom of the picture. Channels are interleaved.
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
    scalar,         ///< height or mask: of 1 channel, the first one of the file
    normal,         ///< tangent-space normal: 3 channels in [0,1]; the normal is 2 texel - 1
    object_normal,  ///< object- or world-space normal: 3 channels, the vector itself
};

/// Loads a texture: its display window, 0 where the file has no data. Of EXR files with several layers, the one that
/// fits (io/texture_channels.h). Integer formats become [0,1] whatever their bits, float stays as it is; no colour
/// conversion.
///
/// Normals: when the file has two channels (x, y), the third becomes sqrt(1 - x^2 - y^2) [Mik20 eq. 16]. Float files
/// that hold signed components are brought to [0,1], so that the caller unpacks all files alike.
///
/// Object-space normals: integer formats hold (v + 1) / 2, and so do float files whose vectors have unit length only
/// when they are read so. In integer formats, vectors shorter than 1/8 become 0: they are no normals but the grey that
/// a bake leaves between its charts.
///
/// Throws Error when the file is missing, empty, damaged, has the wrong number of channels, or a NaN or Inf texel.
Image load_texture(const std::filesystem::path& file, ImageUse use);

/// Loads slopes: an image of 2 channels, dh/ds and dh/dt per unit of texture coordinate, with t pointing up. Files of
/// `maketx --bumpslopes` are recognised by their channels b1_dhds and b2_dhdt; their header says the unit of their
/// slopes, and the means of squares and product that they bring are three channels more: ss, st, tt. Of other files the
/// first two channels are read as `encoding` and `unit` say. Throws as load_texture does,
/// and when slopes of metres over metres are asked of a file of `maketx --bumpslopes`, which has none.
Image load_slopes(const std::filesystem::path& file, Encoding encoding, SlopeUnit unit);

/// Loads a texture in the way that its content asks for.
Image load_bump(const TextureUse& use);

}  // namespace wrinkle
