#pragma once

#include "tests/cases/surface_derivatives.h"
#include "tests/reference/tbn.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::cases {

/// Surface gradients of slopes along the screen, listing 6 with isDerivScreenSpace: golden rows, and footprints of any
/// size and stretch.
inline Cases screen_slope_cases() {
    Cases c{.name = "listing06_scale_dependent, screen"};
    const auto answer = [&](const SurfaceDerivatives& d, V2 dh_dxy) {
        c.in("n", d.n), c.in("dp_dx", d.dp_dx), c.in("dp_dy", d.dp_dy), c.in("dh_dxy", dh_dxy);
        c.out("g", reference::surface_gradient_from_screen_slope(normalize(d.n), d.dp_dx, d.dp_dy, dh_dxy));
        if (const real factor = misfit(d); std::isfinite(factor)) c.allowance.back() = factor;
    };
    const GoldenTable table = reference::golden("listing06_scale_dependent");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(golden_derivatives(table, i), table.vec2(i, "deriv"));
        if (finite(table.vec(i, "want_sgScr"))) c.want["g"].back() = table.vec(i, "want_sgScr");
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const SurfaceDerivatives d = random_derivatives(random);
        const real size = random.magnitude(-3, 3) * length(d.dp_dx);
        c.add("screen slopes, any footprint, seed " + std::to_string(seed), true);
        answer(d, {static_cast<float>(random.uniform(-1, 1) * size), static_cast<float>(random.uniform(-1, 1) * size)});
    }
    c.add("screen slopes, parallel footprint", true);
    answer({V{0, 0, 1}, V{1, 2, 0}, V{2, 4, 0}, {}}, {1, 1});
    return c;
}

/// Slope times frame, listing 3.
inline Cases tbn_cases() {
    Cases c{.name = "listing03_surfgrad_tbn"};
    const GoldenTable table = reference::golden("listing03_surfgrad_tbn");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {"T", "B"});
        c.in("slope", table.vec2(i, "d"));
        c.out("g", table.vec(i, "want_sg"));
    }
    return c;
}

/// Scale-dependent surface gradient, listing 6. The table's slopes per texel are made slopes per unit of texture
/// coordinate and rounded to float.
inline Cases scale_dependent_cases() {
    Cases c{.name = "listing06_scale_dependent"};
    const auto answer = [&](const SurfaceDerivatives& d, V2 deriv, V2 dim) {
        const V2 slope{static_cast<float>(deriv.x * dim.x), static_cast<float>(deriv.y * dim.y)};
        add_inputs(c, d), c.in("dh_dst", slope);
        c.out("g", reference::surface_gradient_scale_dependent(normalize(d.n), d.dp_dx, d.dp_dy, d.st, slope));
        const auto terms = [&](V2 st) { return std::abs(st.x * slope.x) + std::abs(st.y * slope.y); };
        const V along = d.dp_dy * dot(d.st.dx, slope) - d.dp_dx * dot(d.st.dy, slope);
        const real kept = length(cross(along, normalize(d.n)));
        const real cancels = (length(d.dp_dy) * terms(d.st.dx) + length(d.dp_dx) * terms(d.st.dy)) / kept;
        if (kept > 0 && std::isfinite(misfit(d))) c.allowance.back() = misfit(d) + cancels;
    };
    const GoldenTable table = reference::golden("listing06_scale_dependent");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(golden_derivatives(table, i), table.vec2(i, "deriv"), table.vec2(i, "dim"));
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        c.add("scale dependent, any footprint, seed " + std::to_string(seed), true);
        const SurfaceDerivatives d = random_derivatives(random);
        answer(d, {random.uniform(-1, 1), random.uniform(-1, 1)}, {1024, 512});
    }
    for (unsigned seed = 1; seed <= 20; ++seed) {  // a footprint without area: there is no gradient
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        d.dp_dy = seed % 2 ? V{} : d.dp_dx;
        c.add("scale dependent, parallel footprint, seed " + std::to_string(seed), true);
        answer(d, {1, 1}, {256, 256});
        c.want["g"].back() = V{};
    }
    return c;
}

/// The tangential part of a volume gradient, listing 8.
inline Cases volume_gradient_cases() {
    Cases c{.name = "listing08_volume_gradient"};
    const GoldenTable table = reference::golden("listing08_volume_gradient");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {"n"});
        c.in("dh_dp", table.vec(i, "g"));
        c.out("g", table.vec(i, "want_sg"));
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit(),
                g = Random::rounded((n + random.unit() * random.magnitude(-7, 1)) * random.magnitude(-30, 30));
        c.add("volume gradient, any angle to n, seed " + std::to_string(seed), true);
        c.in("n", n), c.in("dh_dp", g);
        c.out("g", reference::surface_gradient_from_volume(n, g));
    }
    return c;
}

}  // namespace wrinkle::cases
