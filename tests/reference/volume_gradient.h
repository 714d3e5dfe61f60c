#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// [Mik20 eq. 6, listing 8] The part of a volume gradient tangent to n: g - n (n.g); n of any length.
/// Written as n x (g x n) / (n.n), which does not cancel where g is nearly parallel to n.
template <class T>
Vec<T> surface_gradient_from_volume(Vec<T> n, Vec<T> g) {
    return cross(n, cross(g, n)) / dot(n, n);
}

}  // namespace wrinkle::reference
