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
    for (unsigned seed = 1; seed <= 200; ++seed) {  // sums of bumps, of which some are subtracted
        Random random(seed);
        const V n = random.unit();
        V sum{};
        for (int i = 0; i < 4; ++i) sum = sum + random.unit() * (random.uniform(-2, 2) * random.magnitude(-3, 1));
        const V g = Random::rounded(sum);
        for (const V each : {g, -g}) {
            c.add("resolve of weighted bumps, seed " + std::to_string(seed), true);
            c.in("n", n), c.in("g", each);
            c.out("normal", reference::resolve(n, each));
        }
    }
    const real largest = std::numeric_limits<float>::max();
    for (const V g : {V{largest, largest, -largest}, V{largest, 0, 0}, V{1e-45L, 0, 0}, V{}, V{0, 0, 1}}) {
        c.add("resolve of an extreme", true);
        c.in("n", V{0, 0, 1}), c.in("g", g);
        c.out("normal", reference::resolve(V{0, 0, 1}, g));  // the last g equals n: the only gradient without an answer
    }
    return c;
}

/// Perlin's perturbation: volume gradients at any angle to n, also those that turn the normal inwards.
inline Cases perlin_perturbation_cases() {
    Cases c{.name = "Perlin's perturbation"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V n = random.unit();
        V g = random.unit() * (hard ? random.magnitude(-30, 30) : random.uniform(0, 1));
        if (seed % 10 == 0) g = n + random.unit() * random.magnitude(-6, -1);  // nearly cancels n
        g = Random::rounded(g);
        c.add("perlin perturbation, seed " + std::to_string(seed), hard);
        c.in("n", n), c.in("dh_dp", g);
        c.out("normal", normalize(n - g));
    }
    c.add("perlin perturbation, nothing left", true);
    c.in("n", V{0, 0, 1}), c.in("dh_dp", V{0, 0, 1}), c.out("normal", V{});
    return c;
}

}  // namespace wrinkle::cases
