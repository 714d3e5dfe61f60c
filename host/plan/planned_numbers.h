#pragma once

#include "plan/section.h"

namespace wrinkle {

/// Adds numbers of a scene to the plan's; gives the index of the first of them. How many there are is compiled in.
std::size_t add_numbers(Emitter& emitter, const std::string& name,
                        std::function<std::vector<double>(const NumberSource&)> of);

}  // namespace wrinkle
