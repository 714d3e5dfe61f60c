#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "plan/section.h"

namespace wrinkle {

/// A mask of a scene: a layer's, or the lighting's.
struct MaskPlace {
    std::string what;  ///< it is of: `layer "dents"`
    std::string who;   ///< starts messages
    std::function<const Mask&(const Scene&)> mask;
    bool bumps = false;  ///< it is for the surface that the pixel's geometry is of, not for all that a picture shows
};

MaskPlace mask_of_layer(const Emitter& emitter, const Layer& layer);

/// Kernel text that declares `m`, the product of the factors of a mask that come from planes; not inverted.
std::string mask_of_planes(Emitter& emitter, const MaskPlace& place, Section& section);

/// Hashes of the objects that a mask's Cryptomatte names stand for, each once: of a pattern all whose names it matches.
/// Throws Error, which begins with `who`, where one stands for nothing, or all of them for too many.
std::vector<std::uint32_t> cryptomatte_hashes(const std::map<std::string, std::uint32_t>& known,
                                              const std::vector<std::string>& names, const std::string& who);

}  // namespace wrinkle
