#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/image_parts.h"

namespace wrinkle::io {

/// How many blocks of a frame may be read where a quick look has to do, `most` at most: fewer, the more each one holds.
std::uint32_t blocks_at_a_glance(std::span<const Part> parts, std::uint32_t most);

/// Rows for such looks: at most 9, spread over the frame, the middle one first.
std::vector<std::uint32_t> glance_rows(std::span<const Part> parts, std::uint32_t height);

}  // namespace wrinkle::io
