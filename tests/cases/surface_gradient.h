#pragma once

#include "tests/cases/surface_derivatives.h"
#include "tests/reference/tbn.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::cases {

constexpr double scale_dependent_degrees = 1e-5, scale_dependent_relative = 1e-6;
constexpr double volume_gradient_relative = 2e-7;

/// Slope times frame, listing 3.
inline Cases tbn_cases() {
    Cases c{.name = "listing03_surfgrad_tbn"};
    const GoldenTable table = reference::golden("listing03_surfgrad_tbn");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {"T", "B"});
        c.in("d", table.vec2(i, "d"));
        c.out("sg", table.vec(i, "want_sg"));
    }
    return c;
}

/// Scale-dependent surface gradient, listing 6: slopes are `deriv` per texel times `dim` texels.
inline Cases scale_dependent_cases() {
    Cases c{.name = "listing06_scale_dependent"};
    const auto slopes = [&](V2 deriv, V2 dim) { c.in("deriv", deriv), c.in("dim", dim); };
    const GoldenTable table = reference::golden("listing06_scale_dependent");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {}, table.text(i, "category") == "normal_in_tangent_plane" ? 20 : 1);
        add_inputs(c, golden_derivatives(table, i));
        slopes(table.vec2(i, "deriv"), table.vec2(i, "dim"));
        c.out("sg", table.vec(i, "want_sg"));
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const SurfaceDerivatives d = random_derivatives(random);
        const V2 deriv = {random.uniform(-1, 1), random.uniform(-1, 1)}, dim{1024, 512};
        c.add("scale dependent, any footprint, seed " + std::to_string(seed), true);
        add_inputs(c, d), slopes(deriv, dim);
        c.out("sg", reference::surface_gradient_scale_dependent(normalize(d.n), d.dp_dx, d.dp_dy, d.st,
                                                                {deriv.x * dim.x, deriv.y * dim.y}));
    }
    for (unsigned seed = 1; seed <= 20; ++seed) {  // no area on the screen: no gradient
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        d.dp_dy = seed % 2 ? V{} : d.dp_dx;
        c.add("scale dependent, parallel footprint, seed " + std::to_string(seed), true);
        add_inputs(c, d), slopes({1, 1}, {256, 256});
        c.out("sg", V{});
    }
    return c;
}

/// The tangential part of a volume gradient, listing 8.
inline Cases volume_gradient_cases() {
    Cases c{.name = "listing08_volume_gradient"};
    const GoldenTable table = reference::golden("listing08_volume_gradient");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {"n", "g"});
        c.out("sg", table.vec(i, "want_sg"));
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit(),
                g = Random::rounded((n + random.unit() * random.magnitude(-7, 1)) * random.magnitude(-30, 30));
        c.add("volume gradient, any angle to n, seed " + std::to_string(seed), true);
        c.in("n", n), c.in("g", g);
        c.out("sg", reference::surface_gradient_from_volume(n, g));
    }
    return c;
}

}  // namespace wrinkle::cases
