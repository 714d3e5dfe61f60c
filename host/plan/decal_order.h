#pragma once

#include <cstdint>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

/// The order in which the rows of a table are evaluated. If a row replaces: by priority, then by row. If all rows add:
/// along a Morton curve, so that neighbours in space lie together in memory; ties are broken by what the rows hold, so
/// that neither the order nor any rounding depends on the order of the file.
std::vector<std::uint32_t> decal_order(const std::vector<Projector>& rows);

/// The same of the rows of a table of lights: along a Morton curve.
std::vector<std::uint32_t> light_order(const std::vector<Light>& rows);

}  // namespace wrinkle
