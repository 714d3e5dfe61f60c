#pragma once

#include <string>

#include "layers/kinds.h"
#include "tools/render.h"

namespace wrinkle {

/// A hash over all that decides what the files of a frame hold: the scene as it was read, its files and the frame's,
/// the options of the run, this version of wrinkle. The device does not count: a farm has several.
std::string frame_provenance(const scene::SceneFile& file, const RenderOptions& options, int frame);

}  // namespace wrinkle
