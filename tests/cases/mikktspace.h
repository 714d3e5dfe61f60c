#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/vertex_frame.h"

namespace wrinkle::cases {

/// Points of meshes with tangents by the implementation of the mikkTSpace standard, interpolated and not normalised,
/// and a tangent-space normal at each. The answer is the normal that a renderer without surface gradients computes.
inline Cases mikktspace_cases(const std::string& name) {
    Cases c{.name = name};
    const GoldenTable table = reference::golden(name);
    for (std::size_t first = 0; first + 2 < table.size(); ++first) {
        if (table.number(first, "corner") != 0) continue;
        Random random(static_cast<unsigned>(first) + 1);
        const real a = random.uniform(0, 1), b = random.uniform(0, 1 - a), weights[] = {1 - a - b, a, b};
        V n, tangent;
        for (std::size_t k = 0; k < 3; ++k) {
            n = n + table.vec(first + k, "N") * weights[k];
            tangent = tangent + table.vec(first + k, "tan") * weights[k];
        }
        n = Random::rounded(n), tangent = Random::rounded(tangent);
        const real sign = table.number(first, "tan.w");
        V m = random.unit();
        m.z = std::abs(m.z) + 0.02L;
        m = Random::rounded(m);
        c.add(name + " face " + table.text(first, "face"), false);
        c.in("n", n), c.in("tangent", tangent), c.in("tangent_sign", sign), c.in("m", m);
        c.out("normal", reference::mikkt_normal(n, tangent, sign, m));
    }
    return c;
}

}  // namespace wrinkle::cases
