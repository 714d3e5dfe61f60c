#pragma once

#include "run/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/screen_derivative.h"

namespace wrinkle::cases {

namespace detail {

using reference::Mat4x4;

inline V xyz(const reference::Vec4<real>& c) { return {c[0], c[1], c[2]}; }

/// A row of listing 10, shifted to its eye in long double, as the host does: s = c2 / w2, or for a parallel projection
/// any point, here the near corner of the picture.
struct Row {
    V position, n;  ///< position relative to the eye
    Mat4x4<real> m;
    real x, y;
    bool parallel;

    V c(int i) const { return xyz(reference::column(m, i)); }
    V axis(int i) const {  ///< of the image, up to multiples of the ray
        const auto w = [&](int k) { return m[3][static_cast<std::size_t>(k)]; };
        return parallel ? c(i) * w(3) - c(3) * w(i) : c(i);
    }
    V ray() const {  ///< direction, as the difference of two homogeneous points on it
        const V a = c(0) * x + c(1) * y + c(3);
        const real a_w = m[3][0] * x + m[3][1] * y + m[3][3];
        return normalize(c(2) * a_w - a * m[3][2]);
    }
};

inline Row shifted(V position, V n, Mat4x4<real> m, real x, real y) {
    Row row{position, n, m, x, y, m[3][2] == 0};
    const int k = row.parallel ? 3 : 2;
    const V eye = row.c(k) / m[3][static_cast<std::size_t>(k)];
    for (std::size_t j = 0; j < 4; ++j)
        row.m[0][j] -= eye.x * m[3][j], row.m[1][j] -= eye.y * m[3][j], row.m[2][j] -= eye.z * m[3][j];
    row.position = Random::rounded(position - eye);
    return row;
}

inline void put(double (&to)[3], V v) {
    to[0] = static_cast<double>(v.x), to[1] = static_cast<double>(v.y), to[2] = static_cast<double>(v.z);
}

inline wr_frame frame_of(const Row& row) {
    wr_frame f{};
    put(f.c0, row.c(0)), put(f.c1, row.c(1)), put(f.c2, row.c(2)), put(f.c3, row.c(3));
    for (std::size_t i = 0; i < 4; ++i) f.w[i] = static_cast<double>(row.m[3][i]);
    const real unit = 1 / length(row.c(0) * row.x + row.c(1) * row.y + row.c(3));  // rays of any scale serve
    const V d0 = row.c(3) * unit, dx = row.c(0) * unit, dy = row.c(1) * unit;
    put(f.d0, d0), put(f.dx, dx), put(f.dy, dy);
    put(f.dx_cross_d0, cross(dx, d0)), put(f.dx_cross_dy, cross(dx, dy));
    put(f.dy_cross_d0, cross(dy, d0)), put(f.dy_cross_dx, cross(dy, dx));
    return f;
}

/// `pinhole`: the point is the one of the ray nearest to the position, else where the ray meets the position's plane.
inline void add(Cases& c, const std::string& label, bool hard, const Row& row, bool pinhole) {
    const V n = normalize(row.n);
    c.add(label, hard, 1 / std::abs(dot(n, row.ray())));
    const auto sine = [&](int i) { return length(cross(n, normalize(cross(normalize(row.axis(i)), row.ray())))); };
    c.angle_allowance.push_back(1 / std::min(sine(0), sine(1)));
    c.in("n", row.n), c.in("p", row.position), c.in("x", row.x), c.in("y", row.y);
    const V d0 = row.c(0) * row.x + row.c(1) * row.y + row.c(3);
    const auto d =
        pinhole ? reference::screen_derivative_pinhole(dot(row.position, d0) / dot(d0, d0), n, d0, row.c(0), row.c(1))
                : reference::screen_derivative(row.position, n, row.m, row.x, row.y);
    c.out("dp_dx", d.dp_dx), c.out("dp_dy", d.dp_dy);
    const wr_frame f = frame_of(row);
    const double* numbers = &f.width;
    c.data.constants.insert(c.data.constants.end(), numbers, numbers + sizeof(wr_frame) / sizeof(double));
}

}  // namespace detail

/// The rows of listing 10, answered anew, because positions relative to the eye are rounded to other floats than those
/// of the table; `pinhole` leaves out what has no eye.
inline Cases screen_derivative_cases(bool pinhole) {
    Cases c;
    c.data.constants_per_row = sizeof(wr_frame) / sizeof(double);
    c.name = pinhole ? "listing10, pinhole form" : "listing10, general form";
    const GoldenTable table = reference::golden("listing10_screenderiv_noddxy");
    for (std::size_t i = 0; i < table.size(); ++i) {
        detail::Mat4x4<real> m;
        for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t k = 0; k < 4; ++k) m[r][k] = table.number(i, "M" + std::to_string(r) + std::to_string(k));
        if (pinhole && m[3][2] == 0) continue;
        const detail::Row row =
            detail::shifted(table.vec(i, "pos"), table.vec(i, "n"), m, table.number(i, "x0"), table.number(i, "y0"));
        detail::add(c, c.name + ": " + table.label(i), table.text(i, "set") == "hard", row, pinhole);
    }
    return c;
}

}  // namespace wrinkle::cases
