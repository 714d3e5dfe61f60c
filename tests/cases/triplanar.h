#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/triplanar.h"

namespace wrinkle::cases {

constexpr double triplanar_weight_absolute = 3e-7;  // plus 2e-8 for each unit of sharpness

/// Weights, listing 14; the sharpness of a row is a constant of its own.
struct WeightCases {
    Cases cases;
    std::vector<double> sharpness;
};

inline WeightCases triplanar_weight_cases() {
    WeightCases out{{.name = "listing14_triplanar_weights"}, {}};
    const auto allowance = [](real k) { return 1 + k / 15; };
    const GoldenTable table = reference::golden("listing14_triplanar_weights");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(out.cases, table, i, {"n"}, allowance(table.number(i, "k")));
        out.sharpness.push_back(table.number(i, "k"));
        out.cases.out("w", reference::triplanar_weights<real>(table.vec(i, "n"), table.number(i, "k")));
        const V want = table.vec(i, "want_w");
        if (finite(want)) out.cases.want["w"].back() = want;
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit();
        const real k = random.below(2) ? 3 : random.magnitude(-1, 2.3L);
        out.cases.add("triplanar weights, seed " + std::to_string(seed), true, allowance(k));
        out.cases.in("n", n);
        out.sharpness.push_back(static_cast<double>(k));
        out.cases.out("w", reference::triplanar_weights<real>(n, k));
    }
    return out;
}

/// Volume gradients, listing 13, and their tangential part.
inline Cases triplanar_gradient_cases() {
    Cases c{.name = "listing13_triplanar"};
    const GoldenTable table = reference::golden("listing13_triplanar");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const V2 dx = table.vec2(i, "dx"), dy = table.vec2(i, "dy"), dz = table.vec2(i, "dz");
        const V g = reference::triplanar_volume_gradient(table.vec(i, "w"), dx, dy, dz), want = table.vec(i, "want_sg");
        // What is tangent to n cannot be known better than the gradient itself.
        add_golden_row(c, table, i, {"n", "w"}, std::max(real{1}, length(g) / length(want)));
        c.in("dx", dx), c.in("dy", dy), c.in("dz", dz);
        c.out("volume", g), c.out("sg", want);
    }
    return c;
}

}  // namespace wrinkle::cases
