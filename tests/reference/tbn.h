#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// [Mik20 eq. 17, listing 3] TBN-style surface gradient.
template <class T>
Vec<T> surface_gradient_from_tbn(Vec2<T> d, Vec<T> tangent, Vec<T> bitangent) {
    return tangent * d.x + bitangent * d.y;
}

}  // namespace wrinkle::reference
