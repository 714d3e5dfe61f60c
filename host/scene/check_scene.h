#pragma once

#include <filesystem>
#include <vector>

#include "scene/readers.h"

namespace wrinkle::scene {

/// What wrinkle::check does, for these kinds of layers. Gives what of the scene is compiled in.
std::vector<Structure> check_scene(LayerKinds kinds, const Scene& scene);

/// What of a scene is compiled in, whatever else is wrong with it.
std::vector<Structure> structure_of(LayerKinds kinds, const Scene& scene);

/// The files that a scene was read from or names, except tables, whose rows it holds already. Some of the names may not
/// be those of files.
std::vector<std::filesystem::path> files_of(LayerKinds kinds, const Scene& scene);

/// Throws Error naming the first value of `wanted` that is not that of `made`.
void require_same_structure(const std::vector<Structure>& made, const std::vector<Structure>& wanted);

}  // namespace wrinkle::scene
