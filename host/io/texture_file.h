#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

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
    scalar,  ///< height or mask: the first of 1 or 3 and more channels; the image has 1
    normal,  ///< tangent normal, 3 channels in [0,1]: m = 2 texel - 1
};

/// Loads a texture. Integer formats become [0,1] whatever their bits, float stays as it is; no colour conversion.
///
/// Normals: of two channels (x, y) the third becomes sqrt(1 - x^2 - y^2) [Mik20 eq. 16]; a float file that holds signed
/// components (some x or y below 0) is brought to [0,1], so the caller always unpacks the same way.
///
/// Throws Error when the file is missing, empty, damaged, has the wrong number of channels, or a NaN or Inf texel.
Image load_texture(const std::filesystem::path& file, ImageUse use);

}  // namespace wrinkle
