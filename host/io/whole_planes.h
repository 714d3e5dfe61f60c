#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/gbuffer_reader.h"

namespace wrinkle::io {

/// Planes of a whole frame, for what cannot be done in bands. Throws Error where a row cannot be read, or they would
/// take more memory than may be taken.
std::map<std::string, std::vector<float>> read_whole_planes(const GBufferReader& reader,
                                                            std::span<const std::string> names);

}  // namespace wrinkle::io
