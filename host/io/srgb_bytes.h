#pragma once

#include <cstdint>

namespace wrinkle::io {

/// The sRGB curve, of values in [0,1].
float srgb(float linear);

/// The byte of a PNG for linear light: what srgb() of it rounds to, within [0, 255], without a power for each pixel.
std::uint8_t srgb_byte(float linear);

}  // namespace wrinkle::io
