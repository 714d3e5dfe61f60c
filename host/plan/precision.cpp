#include "plan/precision.h"

#include <algorithm>

namespace wrinkle {

std::vector<Precision> geometry_precisions() { return {Precision::standard, Precision::exact}; }

Precision served(const std::vector<Precision>& ladder, Precision wanted) {
    const auto found = std::ranges::find_if(ladder, [&](Precision precision) { return precision >= wanted; });
    return found == ladder.end() ? ladder.back() : *found;
}

}  // namespace wrinkle
