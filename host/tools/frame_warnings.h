#pragma once

#include <string>
#include <vector>

#include "io/info.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// Why texture coordinates of a frame give no, or bad, derivatives; empty: they are good, or there are none.
std::string uv_problem(const GBufferInfo& info);

/// A line for whatever in a frame spoils layers of the scene without being wrong.
std::vector<std::string> frame_warnings(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera);

/// What there is to say of a scene beside its frame, without running it: why a run would refuse it, or which textures
/// look as if they held something else.
std::vector<std::string> scene_warnings(const Scene& scene, int number);

}  // namespace wrinkle
