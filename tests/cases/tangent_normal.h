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

/// Slopes of the first two components of unit normals, up to the rim and beyond it.
inline Cases tangent_normal_xy_cases() {
    Cases c{.name = "two-channel normals"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const real angle = random.uniform(0, 6.28L);
        const real size = seed % 3 == 0   ? 1 - random.magnitude(-7, -1)
                          : seed % 3 == 1 ? random.uniform(0, 1)
                          : seed % 5 == 0 ? random.magnitude(0, 30)
                                          : random.magnitude(-30, -3);
        const V m = Random::rounded(V{std::cos(angle), std::sin(angle), 0} * size);
        c.add("two-channel normal, seed " + std::to_string(seed), seed % 3 != 1);
        c.in("m", V2{m.x, m.y});
        const real z = std::sqrt(std::max(0.0L, 1 - m.x * m.x - m.y * m.y));
        c.out("slope", reference::slope_from_tangent_normal(V{m.x, m.y, z}));
    }
    return c;
}

}  // namespace wrinkle::cases
