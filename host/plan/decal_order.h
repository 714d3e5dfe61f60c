#pragma once

#include <cstdint>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

/// The order in which rows are evaluated. A table that replaces: by priority, then by row. One that only adds: along a
/// curve through space (Morton), so that neighbours lie together in memory; ties are broken by what the rows hold, so
/// the order, and with it every rounding, does not depend on that of the file.
std::vector<std::uint32_t> decal_order(const std::vector<Projector>& rows);

}  // namespace wrinkle
