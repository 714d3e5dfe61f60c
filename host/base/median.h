#pragma once

#include <algorithm>
#include <vector>

namespace wrinkle {

/// The upper one of the two in the middle, where their number is even; 0 where there are none.
template <class T>
T median(std::vector<T> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace wrinkle
