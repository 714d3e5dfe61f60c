#pragma once

#include "scene/table.h"
#include "wrinkle/layers.h"

/// Where an object is.
namespace wrinkle {

/// Directions of an object's axes in world space.
std::array<Vec3, 3> object_axes(const Placement& placement);

/// Rows of a matrix that takes normals of the object to the world: the inverse transposed of the object's.
std::array<Vec3, 3> normals_to_world(const Placement& placement);

namespace scene {
/// translate, rotate, scale
void read_placement(Table& table, Placement& out);
}  // namespace scene

}  // namespace wrinkle
