#pragma once

#include <string>

namespace wrinkle {

/// What kinds of layers miss of the areas that pixels show, by numbers of points, as the table of costs that comes with
/// wrinkle has it: a section of the page kernels/README.md.
std::string area_table();

}  // namespace wrinkle
