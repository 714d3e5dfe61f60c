#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "budget/cost_table.h"
#include "tools/area_error.h"

namespace wrinkle {

/// Measures every layer of the scenes by itself, on the first frame and where its mask lets it be, with every number of
/// taps of the options (measure_area). Rows of several layers of a kind hold the mean of their times and the largest of
/// their errors.
///   told   gets what is measured next; and of which layers nothing could be, with the reason, such as a camera without
///          perspective, whose pixels' areas are not integrated. The rows lack them.
std::map<std::string, std::map<int, TapsCost>> measure_area_costs(const std::vector<Scene>& scenes,
                                                                  const AreaOptions& options,
                                                                  const std::function<void(const std::string&)>& told);

}  // namespace wrinkle
