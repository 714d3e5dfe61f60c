#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/triplanar.h"

namespace wrinkle::cases {

/// Weights, listing 14; the sharpness of a row is a constant of its own.
inline Cases triplanar_weight_cases() {
    Cases c{.name = "listing14_triplanar_weights"};
    c.data.constants_per_row = 1;
    const auto add = [&](V n, real k, const std::string& label, bool hard) {
        c.add(label, hard, 1 + k / 15);
        c.in("n", n);
        c.data.constants.push_back(static_cast<double>(k));
        c.out("w", reference::triplanar_weights<real>(n, k));
    };
    const GoldenTable table = reference::golden("listing14_triplanar_weights");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add(table.vec(i, "n"), table.number(i, "k"), c.name + ": " + table.label(i), table.text(i, "set") == "hard");
        const V want = table.vec(i, "want_w");
        if (finite(want)) c.want["w"].back() = want;
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit();
        add(n, random.below(2) ? 3 : random.magnitude(-1, 2.3L), "triplanar weights, seed " + std::to_string(seed),
            true);
    }
    return c;
}

/// Volume gradients, listing 13; the table has their tangential part, which the references are tested with.
inline Cases triplanar_gradient_cases() {
    Cases c{.name = "listing13_triplanar"};
    const GoldenTable table = reference::golden("listing13_triplanar");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const V2 x = table.vec2(i, "dx"), y = table.vec2(i, "dy"), z = table.vec2(i, "dz");
        add_golden_row(c, table, i, {"w"});
        c.in("slope_x", x), c.in("slope_y", y), c.in("slope_z", z);
        c.out("dh_dp", reference::triplanar_volume_gradient(table.vec(i, "w"), x, y, z));
    }
    return c;
}

}  // namespace wrinkle::cases
