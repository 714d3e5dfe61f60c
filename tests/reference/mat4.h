#pragma once

#include <array>
#include <stdexcept>
#include <utility>

#include "tests/reference/vec.h"

namespace wrinkle::reference {

template <class T>
using Vec4 = std::array<T, 4>;
template <class T>
using Mat4x4 = std::array<Vec4<T>, 4>;  ///< rows; acts on column vectors

template <class T>
T dot4(const Vec4<T>& a, const Vec4<T>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

template <class T>
Vec4<T> column(const Mat4x4<T>& m, int j) {
    return {m[0][j], m[1][j], m[2][j], m[3][j]};
}

template <class T>
Mat4x4<T> product(const Mat4x4<T>& a, const Mat4x4<T>& b) {
    Mat4x4<T> c{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) c[i][j] = dot4(a[i], column(b, j));
    return c;
}

/// Gauss-Jordan elimination with partial pivoting.
template <class T>
Mat4x4<T> inverted(Mat4x4<T> a) {
    Mat4x4<T> b{};
    for (int i = 0; i < 4; ++i) b[i][i] = 1;
    for (int c = 0; c < 4; ++c) {
        int pivot = c;
        for (int r = c + 1; r < 4; ++r)
            if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
        if (a[pivot][c] == 0) throw std::runtime_error("reference: singular matrix");
        std::swap(a[c], a[pivot]);
        std::swap(b[c], b[pivot]);
        const T s = a[c][c];
        for (int j = 0; j < 4; ++j) a[c][j] /= s, b[c][j] /= s;
        for (int r = 0; r < 4; ++r) {
            if (r == c) continue;
            const T f = a[r][c];
            for (int j = 0; j < 4; ++j) a[r][j] -= f * a[c][j], b[r][j] -= f * b[c][j];
        }
    }
    return b;
}

}  // namespace wrinkle::reference
