#pragma once

#include "plan/plan.h"
#include "scene/layer_kind.h"
#include "scene/scene_file.h"

namespace wrinkle {

/// A row for every file of this folder but kinds.cpp, in the order of the alternatives of Layer::bump.
LayerKinds layer_kinds();

/// The scene of a file, with what else there is to know of it; load_scene() gives the scene alone.
scene::SceneFile load_scene_file(const std::filesystem::path& file, const scene::SceneOptions& options);

/// A plan with every kind of layer there is.
inline Plan make_plan(const Scene& scene, const Available& available, const PlanOptions& options = {}) {
    return make_plan(layer_kinds(), scene, available, options);
}

}  // namespace wrinkle
