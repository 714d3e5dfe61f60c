#pragma once

#include <fmt/format.h>

#include "resources/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/screen_derivative.h"

namespace wrinkle::cases {

namespace detail {

using reference::Mat4x4;

inline V xyz(const reference::Vec4<real>& c) { return {c[0], c[1], c[2]}; }

/// A row of listing 10, moved to eye-relative positions in long double, as the host does. The eye is s = c2 / w2. A
/// parallel projection has none, so any point serves: the near corner of the picture.
struct Row {
    V position, n;  ///< position relative to the eye
    Mat4x4<real> m;
    real x, y;
    bool parallel;

    V c(int i) const { return xyz(reference::column(m, i)); }
    V axis(int i) const {  ///< axis i of the image, of any length, and with any multiple of the ray added
        const auto w = [&](int k) { return m[3][static_cast<std::size_t>(k)]; };
        return parallel ? c(i) * w(3) - c(3) * w(i) : c(i);
    }
    V ray() const {  ///< the ray's direction: the difference of two homogeneous points on it
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

inline wr_camera frame_of(const Row& row) {
    wr_camera f{};
    put(f.c0, row.c(0)), put(f.c1, row.c(1)), put(f.c2, row.c(2)), put(f.c3, row.c(3));
    for (std::size_t i = 0; i < 4; ++i) f.w[i] = static_cast<double>(row.m[3][i]);
    // The length of a ray's direction does not matter.
    const real unit = 1 / length(row.c(0) * row.x + row.c(1) * row.y + row.c(3));
    const V d0 = row.c(3) * unit, dx = row.c(0) * unit, dy = row.c(1) * unit;
    put(f.d0, d0), put(f.dx, dx), put(f.dy, dy);
    put(f.dx_cross_d0, cross(dx, d0)), put(f.dx_cross_dy, cross(dx, dy));
    put(f.dy_cross_d0, cross(dy, d0)), put(f.dy_cross_dx, cross(dy, dx));
    split_constants(f);
    return f;
}

/// Adds a row. The position may lie a little off the pixel's ray. With `pinhole`, the point that is differentiated is
/// the one of the ray nearest to it; else the one where the ray meets the plane through it.
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
    const wr_camera f = frame_of(row);
    const double* numbers = &f.width;
    c.data.constants.insert(c.data.constants.end(), numbers, numbers + sizeof(wr_camera) / sizeof(double));
}

struct Projection {
    const char* name;
    Mat4x4<real> clip_from_view;
};

/// Projections of every depth convention, and parallel ones.
inline std::vector<Projection> projections() {
    const auto perspective = [](reference::Vec4<real> depth) {
        return Mat4x4<real>{{{1.2L, 0, 0.1L, 0}, {0, 2, -0.2L, 0}, depth, {0, 0, -1, 0}}};
    };
    const real near = 0.1L, far = 200;
    return {{"perspective", perspective({0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)})},
            {"infinite depth", perspective({0, 0, -1, -2 * near})},
            {"reversed depth", perspective({0, 0, near / (far - near), far * near / (far - near)})},
            {"reversed infinite depth", perspective({0, 0, 0, near})},
            {"oblique near plane", perspective({0.3L, -0.2L, -1.5L, -0.7L})},
            {"orthographic", {{{0.1L, 0, 0, 0.2L}, {0, 0.2L, 0, -0.1L}, {0, 0, -0.02L, -1}, {0, 0, 0, 1}}}},
            {"orthographic, reversed", {{{0.1L, 0, 0, 0}, {0, 0.2L, 0, 0}, {0, 0, 0.01L, 1}, {0, 0, 0, 1}}}}};
}

/// A screen, which maps (x, y, depth, 1) to normalised device coordinates.
struct Screen {
    const char* name;
    Mat4x4<real> ndc_from_screen;
};
inline std::vector<Screen> screens() {
    const auto screen = [](real sx, real sy, real ox, real oy) {
        return Mat4x4<real>{{{sx, 0, 0, ox}, {0, sy, 0, oy}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    };
    return {{"pixels", screen(2 / 1920.0L, -2 / 1080.0L, -1, 1)},
            {"[-1,1]", screen(1, 1, 0, 0)},
            {"[-1,1], y flipped", screen(1, -1, 0, 0)}};
}

/// Adds points before cameras of every convention, with normals at any angle to their rays, down to a millionth of a
/// radian from being seen edge on.
inline void add_conventions(Cases& c, bool pinhole) {
    unsigned seed = 0;
    for (const Projection& projection : projections())
        for (const Screen& screen : screens())
            for (int i = 0; i < 10; ++i) {
                Random random(++seed);
                const V back = random.unit(), right = normalize(cross(random.unit(), back)), up = cross(back, right);
                const V eye = random.box(20);
                const Mat4x4<real> view{{{right.x, right.y, right.z, -dot(right, eye)},
                                         {up.x, up.y, up.z, -dot(up, eye)},
                                         {back.x, back.y, back.z, -dot(back, eye)},
                                         {0, 0, 0, 1}}};
                const Mat4x4<real> to_clip = reference::product(projection.clip_from_view, view);
                const auto from_screen = reference::product(reference::inverted(to_clip), screen.ndc_from_screen);
                if (pinhole && from_screen[3][2] == 0) continue;
                const real z = random.magnitude(0, 2);
                const V p =
                    eye + right * (z * random.uniform(-0.7L, 0.7L)) + up * (z * random.uniform(-0.4L, 0.4L)) - back * z;
                const reference::Vec4<real> point{p.x, p.y, p.z, 1};
                const real w = reference::dot4(to_clip[3], point);
                const auto on_screen = [&](std::size_t k) {
                    return real{
                        static_cast<float>((reference::dot4(to_clip[k], point) / w - screen.ndc_from_screen[k][3]) /
                                           screen.ndc_from_screen[k][k])};
                };
                Row row = shifted(p, {}, from_screen, on_screen(0), on_screen(1));
                const V ray = row.ray(), side = normalize(cross(ray, random.unit()));
                row.n = Random::rounded(normalize(ray * random.magnitude(-6, 0) + side));
                const std::string label = fmt::format("{}, {}, seed {}", projection.name, screen.name, seed);
                add(c, label, i >= 5, row, pinhole);
            }
}

}  // namespace detail

/// The golden rows of listing 10 and cameras of every convention. The golden rows are answered anew: eye-relative
/// positions are rounded to other floats than the positions of the table. `pinhole` leaves out cameras that have no
/// eye.
inline Cases screen_derivative_cases(bool pinhole) {
    Cases c;
    c.data.constants_per_row = sizeof(wr_camera) / sizeof(double);
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
    detail::add_conventions(c, pinhole);
    return c;
}

}  // namespace wrinkle::cases
