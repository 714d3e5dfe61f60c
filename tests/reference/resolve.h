#pragma once

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// [Mik20 eq. 5, listing 1] normalize(n - g).
template <class T>
Vec<T> resolve(Vec<T> n, Vec<T> g) {
    return normalize(n - g);
}

/// [Mik20 3.7] A normal n that faces away from v (unit, towards the eye) is reflected: n - 2 (v.n) v.
template <class T>
Vec<T> face_viewer(Vec<T> n, Vec<T> v) {
    const T nv = dot(n, v);
    return nv < 0 ? n - v * (2 * nv) : n;
}

}  // namespace wrinkle::reference
