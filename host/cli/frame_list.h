#pragma once

#include <string>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle::cli {

/// "1-10", "1-100x5", "3,7,9-12": every number named, in order, each once. Throws Error.
std::vector<int> parse_frames(const std::string& text);

/// Throws Error when frames are asked of a scene without a frame pattern, or the other way round.
void check_frame_pattern(const Scene& scene, const std::string& frames);

}  // namespace wrinkle::cli
