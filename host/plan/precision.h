#pragma once

#include "plan/plan.h"

namespace wrinkle {

/// The variants in float that layer `index` has, from cheap to exact; standard is always among them.
std::vector<Precision> layer_precisions(const Scene& scene, std::size_t index, CameraKind camera);

/// Those of positions and screen derivatives.
std::vector<Precision> geometry_precisions();

/// The variant of `ladder` that serves `wanted`.
Precision served(const std::vector<Precision>& ladder, Precision wanted);

}  // namespace wrinkle
