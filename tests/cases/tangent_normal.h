#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/tangent_normal.h"

namespace wrinkle::cases {

/// Slopes of tangent-space normals m: golden rows, and normals of every length and steepness.
inline Cases tangent_normal_cases() {
    Cases c{.name = "listing02_tspace_to_deriv"};
    const GoldenTable table = reference::golden("listing02_tspace_to_deriv");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        c.in("m", table.vec(i, "vM"));
        const V2 want = table.vec2(i, "want_flip0_d");
        c.out("slope", finite(want) ? want : V2{0, 0});  // m = 0 is flat
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        V m = random.box(1);
        m.z *= random.magnitude(-4, 0);
        m = Random::rounded(m * random.magnitude(-30, 30));
        c.add("tangent normal, seed " + std::to_string(seed), true);
        c.in("m", m);
        c.out("slope", reference::slope_from_tangent_normal(m));
    }
    return c;
}

}  // namespace wrinkle::cases
