#pragma once

#include <cstdint>
#include <vector>

#include "io/texture_file.h"
#include "plan/plan.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// Mip pyramids of every texture of a plan in one buffer, and the table that kernels find them with (layout.h).
struct TextureHeap {
    std::vector<float> texels;
    std::vector<std::uint32_t> table;
};

/// Floats after all texels: the last pair of a row may be read as four floats.
constexpr std::size_t kTexelsAfterTheLast = 4;

/// Adds one image as the plan's texels: heights and masks as they are; heights for the smooth upscale as slopes by the
/// Sobel operator per level [Mik20 eq. 20, 21]; tangent normals as slopes per texel [listing 2], mip-mapped as slopes;
/// slopes as they are; object-space normals as vectors of four floats.
void add_texture(TextureHeap& heap, const Image& image, const PlannedTexture& planned);

/// Loads all textures of a plan. Throws Error for files that cannot be used, naming the layer that does.
TextureHeap load_textures(const std::vector<PlannedTexture>& planned);

/// Throws Error, with the sizes, where the heap is more than one buffer of the device may hold.
void check_fits(const TextureHeap& heap, const DeviceInfo& device);

}  // namespace wrinkle
