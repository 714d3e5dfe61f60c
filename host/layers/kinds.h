#pragma once

#include "plan/plan.h"
#include "scene/layer_kind.h"

namespace wrinkle {

/// A row for every file of this folder but kinds.cpp, in the order of the alternatives of Layer::bump.
LayerKinds layer_kinds();

/// A plan with every kind of layer there is.
inline Plan make_plan(const Scene& scene, const Available& available, const PlanOptions& options = {}) {
    return make_plan(layer_kinds(), scene, available, options);
}

}  // namespace wrinkle
