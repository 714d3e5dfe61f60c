#pragma once

#include <optional>
#include <string>
#include <vector>

#include "look/look.h"

namespace wrinkle {

/// What can be shown of an image: pictures by their names.
///
///   lit, before          the new picture and the one to compare it with, where the scene is relit
///   normal, base_normal  (n + 1) / 2
///   roughness            as the bumps of a pixel's area widen it
///   marked               pixels that are special, by the colours of kMarkedColors
///   condition            grey: powers of ten, white for a million
std::vector<std::string> picture_names(const LookImage& image);

/// A colour for every bit of the plane `marked` (wrinkle/gbuffer.h).
struct MarkedColor {
    int bit;
    const char* color;  ///< as CSS has it: "#rrggbb"
    const char* meaning;
};
extern const std::vector<MarkedColor> kMarkedColors;

/// A picture as the bytes of a PNG: exact, and made quickly. Nothing where the image has none of that name.
std::optional<std::string> png_of(const LookImage& image, const std::string& name);

/// A picture as the bytes of a WebP file, small enough to be sent to somebody. A picture wider or higher than
/// `longest` pixels is shrunk to that, pixels averaged. Throws Error where there is none.
std::string webp_of(const LookImage& image, const std::string& name, std::uint32_t longest);

}  // namespace wrinkle
