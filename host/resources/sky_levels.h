#pragma once

#include <filesystem>

#include "resources/texture_heap.h"

namespace wrinkle {

/// Adds the picture of a sky as surfaces mirror it: octahedral, in WR_SKY_LEVELS levels, of which level k is blurred by
/// the lobe that a surface with alpha = WR_SKY_ALPHA WR_SKY_ALPHA_RATIO^k mirrors when it is seen along its normal.
/// `file` is a picture as load_sky takes it; none: red, green and blue are how much of a sky of two colours is its
/// zenith, its horizon and its ground. Throws Error where the file is no such picture.
void add_sky_levels(TextureHeap& heap, const std::filesystem::path& file);

/// Adds the table of GGX's lobes.
void add_lobes(TextureHeap& heap);

}  // namespace wrinkle
