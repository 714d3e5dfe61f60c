#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/scale_dependent.h"

namespace wrinkle::cases {

/// Screen derivatives of a surface point (dp/dx and dp/dy, tangent to the surface of normal n) and of its texture
/// coordinates (d(s,t)/dx and d(s,t)/dy).
struct SurfaceDerivatives {
    V n, dp_dx, dp_dy;
    reference::TexDerivative<real> st;
};

/// The columns of golden tables 04, 06 and 11 as inputs n, dp_dx, dp_dy, dst_dx, dst_dy.
inline SurfaceDerivatives golden_derivatives(const GoldenTable& table, std::size_t row) {
    return {table.vec(row, "n"),
            table.vec(row, "dPdx"),
            table.vec(row, "dPdy"),
            {table.vec2(row, "dSTdx"), table.vec2(row, "dSTdy")}};
}

inline void add_inputs(Cases& c, const SurfaceDerivatives& d) {
    c.in("n", d.n), c.in("dp_dx", d.dp_dx), c.in("dp_dy", d.dp_dy), c.in("dst_dx", d.st.dx), c.in("dst_dy", d.st.dy);
}

/// 1 / cos of the angle between n and the normal of the plane of dp_dx and dp_dy: the factor by which errors grow in
/// variants without compensation.
inline real misfit(const SurfaceDerivatives& d) {
    const V normal = cross(d.dp_dx, d.dp_dy);
    return length(normal) * length(d.n) / std::abs(dot(normal, d.n));
}

/// A footprint of any size, stretched by up to 1e6 : 1, as at grazing angles; with texture coordinates of any scale,
/// also sheared, mirrored or nearly degenerate.
inline SurfaceDerivatives random_derivatives(Random& random) {
    SurfaceDerivatives d;
    d.n = random.unit();
    const V u = normalize(cross(d.n, random.unit())), v = cross(normalize(d.n), u);
    const real size = random.magnitude(-9, 6), stretch = random.magnitude(0, 6), angle = random.uniform(0, 6.28L);
    const real c = std::cos(angle), s = std::sin(angle);
    d.dp_dx = Random::rounded((u * c + v * (s * stretch)) * size);
    d.dp_dy = Random::rounded((u * -s + v * (c * stretch)) * size);
    const real scale = random.magnitude(-12, 6), shear = random.magnitude(-4, 0);
    const auto texel = [&](real a, real b) { return V2{static_cast<float>(a * scale), static_cast<float>(b * scale)}; };
    const real a = random.uniform(-1, 1), b = random.uniform(-1, 1);
    d.st.dx = texel(a, b);
    d.st.dy = texel(a * 0.5L + b * shear, b * 0.5L + random.uniform(-1, 1) * shear);
    return d;
}

}  // namespace wrinkle::cases
