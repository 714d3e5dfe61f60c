#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/perturbed_normal.h"

namespace wrinkle::cases {

/// Surface gradients of perturbed normals, listing 5: golden rows, then normals of any length and at any angle to n,
/// also such that face away.
inline Cases perturbed_normal_cases() {
    Cases c{.name = "listing05_perturbed_normal"};
    const auto answer = [&](V n, V v) {  // where n . v cancels, so do digits of the gradient's length
        const V unit = normalize(n);
        const real cosine = std::abs(dot(unit, normalize(v)));
        c.angle_allowance.push_back(1);
        c.allowance.push_back(1 + 2e-8L / std::max(cosine, 1e-18L));
        c.in("n", n), c.in("v", v);
        c.out("g", is_zero(v) ? V{} : reference::surface_gradient_from_normal(unit, v));
    };
    const GoldenTable table = reference::golden("listing05_perturbed_normal");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        c.allowance.pop_back();
        answer(table.vec(i, "n"), table.vec(i, "v"));
        if (finite(table.vec(i, "want_sg"))) c.want["g"].back() = table.vec(i, "want_sg");
    }
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const V n = random.unit(), side = normalize(cross(n, random.unit()));
        const real cosine = seed % 4 == 0 ? random.magnitude(-12, -7) : random.magnitude(-6, 0);
        const V v = side + n * (seed % 2 ? cosine : -cosine);
        c.add("perturbed normal, any angle, seed " + std::to_string(seed), true);
        c.allowance.pop_back();
        answer(n, Random::rounded(v * random.magnitude(-30, 30)));
    }
    for (const V v : {V{}, V{3, 0, 0}, V{0, -1e30L, 0}}) {  // no direction, and directions exactly in the tangent plane
        c.add("perturbed normal without a cosine", true);
        c.allowance.pop_back();
        answer({0, 0, 1}, v);
        if (!is_zero(v)) c.want["g"].back() = v * std::exp2(-std::floor(std::log2(largest(v)))) * -1e18L;
        c.allowance.back() = 1;
    }
    return c;
}

}  // namespace wrinkle::cases
