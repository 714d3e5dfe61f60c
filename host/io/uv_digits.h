#pragma once

#include "io/gbuffer_reader.h"

namespace wrinkle::io {

/// How many digits texture coordinates have. A writer may store 16-bit floats, or numbers of 8 bits, in 32-bit
/// channels.
enum class UvDigits { enough, half, byte };

/// By the channels' type, and by the values of a few rows.
UvDigits uv_digits(const GBufferReader& reader);

}  // namespace wrinkle::io
