#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/resolve.h"

namespace wrinkle::cases {

/// normalize(n - g): golden rows, and gradients of every length.
inline Cases resolve_cases() {
    Cases c{.name = "listing01_resolve"};
    const GoldenTable table = reference::golden("listing01_resolve");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {"n"});
        c.in("g", table.vec(i, "sg"));
        c.out("normal", table.vec(i, "want_N"));
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit();
        const V g = Random::rounded(random.unit() * random.magnitude(-44, 38));
        c.add("resolve of any length, seed " + std::to_string(seed), true);
        c.in("n", n), c.in("g", g);
        c.out("normal", reference::resolve(n, g));
    }
    const real largest = std::numeric_limits<float>::max();
    for (const V g : {V{largest, largest, -largest}, V{largest, 0, 0}, V{1e-45L, 0, 0}, V{}, V{0, 0, 1}}) {
        c.add("resolve of an extreme", true);
        c.in("n", V{0, 0, 1}), c.in("g", g);
        c.out("normal", reference::resolve(V{0, 0, 1}, g));  // n = g: zero, the one gradient without an answer
    }
    return c;
}

}  // namespace wrinkle::cases
