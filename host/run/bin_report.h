#pragma once

#include <optional>

#include "io/gbuffer_reader.h"
#include "resources/tile_bins.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// What the bins of a scene's tables hold on a frame, all of it at once; nothing where there is no such table.
struct FrameBins {
    std::optional<BinReport> decals, lights;
};

/// `reader` is open on the frame, and turns its normals.
FrameBins bin_report(const Device& device, const Scene& scene, const Frame& frame, const GBufferReader& reader);

}  // namespace wrinkle
