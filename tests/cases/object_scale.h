#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/object_scale.h"

namespace wrinkle::cases {

/// Objects that are turned, sheared, mirrored and scaled. Hard ones are scaled by up to 1e3 : 1 between their axes, and
/// by 1e-12 to 1e12 in all. Gradients are tangent to n. Larger errors are allowed where the terms of a sum are much
/// longer than the sum.
inline Cases object_scale_cases() {
    Cases c{.name = "objects of any scale"};
    c.data.constants_per_row = 9;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const real size = hard ? random.magnitude(-12, 12) : 1, spread = hard ? 1.5L : 0.3L;
        const auto axis = [&] { return Random::rounded(random.unit() * (size * random.magnitude(-spread, spread))); };
        const reference::Columns3<real> m{axis(), axis(), axis()};
        const V n = random.unit(), unit = normalize(n), v = random.unit();
        const V g =
            Random::rounded(normalize(v - unit * dot(v, unit)) * random.magnitude(hard ? -4 : -2, hard ? 2 : 0));
        const V bumped = unit - g, yz = cross(m.y, m.z), zx = cross(m.z, m.x), xy = cross(m.x, m.y);
        const auto terms = [&](V a) {
            const V cofactors[] = {yz * a.x, zx * a.y, xy * a.z};
            const V lengths[] = {{length(m.y) * length(m.z) * a.x, 0, 0},
                                 {length(m.z) * length(m.x) * a.y, 0, 0},
                                 {length(m.x) * length(m.y) * a.z, 0, 0}};
            real largest = 0;
            for (const V& l : lengths) largest = std::max(largest, length(l));
            return largest / length(cofactors[0] + cofactors[1] + cofactors[2]);
        };
        // By how much the map stretches the directions of the normal and of the bump.
        const real growth = std::max({real{1}, terms(bumped), terms(unit), terms(g / length(g))});
        c.add("object scale, seed " + std::to_string(seed), hard, growth);
        for (const V column : {m.x, m.y, m.z})
            for (const real part : {column.x, column.y, column.z})
                c.data.constants.push_back(static_cast<double>(part));
        c.in("n", n), c.in("g", g);
        const V world = reference::resolve_object(m, unit, V{}), normal = reference::resolve_object(m, unit, g);
        c.out("normal", normal), c.out("world_n", world);
        const real upright = std::abs(dot(world, normal));
        c.out("world_g", upright < 0.1L ? V{std::numeric_limits<real>::quiet_NaN(), 0, 0}
                                        : reference::surface_gradient_to_world(m, unit, g));
    }
    return c;
}

}  // namespace wrinkle::cases
