#pragma once

#include "io/gbuffer_reader.h"
#include "resources/decal_bins.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// What the bins of a scene's tables of decals hold on a frame, all of it at once. `reader` is open on it, and turns
/// its normals.
BinReport bin_report(const Device& device, const Scene& scene, const Frame& frame, const GBufferReader& reader);

}  // namespace wrinkle
