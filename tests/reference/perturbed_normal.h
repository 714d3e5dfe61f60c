#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// [Mik20 3.4, listing 5] Surface gradient of a known normal v (any length): (k n - v) / |k|, k = n.v, n unit.
/// When v is perpendicular to n there is no answer: it is infinite.
template <class T>
Vec<T> surface_gradient_from_normal(Vec<T> n, Vec<T> v) {
    const T k = dot(n, v);
    return (n * k - v) / std::abs(k);
}

}  // namespace wrinkle::reference
