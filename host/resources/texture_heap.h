#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/texture_file.h"
#include "plan/plan.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// Mip pyramids of every texture of a plan in one buffer, and the table that kernels find them with (layout.h).
struct TextureHeap {
    std::vector<float> texels;
    std::vector<std::uint32_t> table;
    std::vector<std::uint32_t> further{};  ///< rows that follow once all of the plan are there: levels of volumes
    std::vector<std::string> doubts{};     ///< of files that look as if they held something else, by the layer
};

/// Floats after all texels: the last pair of a row may be read as four floats.
constexpr std::size_t kTexelsAfterTheLast = 4;

/// Adds one image as the texels that the plan wants: heights and masks as they are; heights for the smooth upscale as
/// slopes by the Sobel operator [Mik20 eq. 20, 21]; tangent normals as slopes [listing 2]; slopes as they are, or what
/// samples of them lose (lost_slopes.h); object-space normals as vectors of four floats. Every texel of a coarser level
/// is a mean of texels of the finest one.
void add_texture(TextureHeap& heap, const Image& image, const PlannedTexture& planned);

/// Loads all textures of a plan. Throws Error for files that cannot be used, naming the layer that does.
TextureHeap load_textures(const std::vector<PlannedTexture>& planned);

/// Throws Error, with the sizes, where the heap is more than one buffer of the device may hold.
void check_fits(const TextureHeap& heap, const DeviceInfo& device);

}  // namespace wrinkle
