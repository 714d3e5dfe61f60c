#pragma once

#include "tests/cases/surface_derivatives.h"

namespace wrinkle::cases {

/// T and B: golden rows, random footprints, and exactly degenerate ones, whose answers are zeros.
inline Cases tangent_frame_cases() {
    Cases c{.name = "listing04_genbasis_tb"};
    const auto answer = [&](const SurfaceDerivatives& d) {
        add_inputs(c, d);
        const auto f = reference::tangent_frame(normalize(d.n), d.dp_dx, d.dp_dy, d.st);
        c.out("T", f.tangent), c.out("B", f.bitangent);
        const real sign = determinant(d.st) < 0 ? -1 : 1;
        const V along = (d.dp_dx * d.st.dy.y - d.dp_dy * d.st.dx.y) * sign, n = normalize(d.n);
        const real kept = length(along - n * dot(n, along));
        if (kept > 0) c.allowance.back() = length(along) / kept;
    };
    const GoldenTable table = reference::golden("listing04_genbasis_tb");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(golden_derivatives(table, i));
        if (is_zero(c.want["T"].back()) || !finite(table.vec(i, "want_T"))) continue;
        c.want["T"].back() = table.vec(i, "want_T"), c.want["B"].back() = table.vec(i, "want_B");
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        c.add("tangent frame of any footprint, seed " + std::to_string(seed), true);
        answer(random_derivatives(random));
    }
    for (unsigned seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        d.st.dy = seed % 2 ? V2{0, 0} : d.st.dx;
        c.add("tangent frame, determinant 0, seed " + std::to_string(seed), true);
        answer(d);
    }
    return c;
}

}  // namespace wrinkle::cases
