#pragma once

#include <span>
#include <string>
#include <vector>

#include "wrinkle/textures.h"

namespace wrinkle::io {

/// Which channels of an EXR texture hold its content, best first where it takes several: those that are named, those of
/// the layer that is named, or those of the one layer that fits. A height is never taken from alpha, and one content
/// never from several layers. Throws Error, with `file` in front, when nothing fits, or several do and none by its
/// name.
std::vector<std::string> texture_channels(std::span<const std::string> names, const TextureUse& use,
                                          const std::string& file);

}  // namespace wrinkle::io
