#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/perturbed_normal.h"
#include "tests/reference/tangent_normal.h"
#include "tests/reference/triplanar.h"

namespace wrinkle::cases {

/// Weights, listing 14. Every row has its own sharpness, as a constant.
inline Cases triplanar_weight_cases() {
    Cases c{.name = "listing14_triplanar_weights"};
    c.data.constants_per_row = 1;
    const auto add = [&](V n, real k, const std::string& label, bool hard) {
        c.add(label, hard);
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
        const std::string label = "triplanar weights, seed " + std::to_string(seed);
        add(n, random.below(2) ? 3 : random.magnitude(-1, 2.3L), label, true);
        add(n, 1 + random.below(200), label + ", whole", true);
        // Two planes with nearly the same weight: a large exponent magnifies their difference most.
        const V close = Random::rounded(normalize(V{1, 1 + random.uniform(-0.02L, 0.02L), random.uniform(-1, 1)}));
        add(close, 128, label + ", close", true);
    }
    return c;
}

/// Volume gradients, listing 13. (The golden table only has their tangential part: it tests the references instead.)
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

/// Weighted object-space normals of any length, of which some face away and some lie nearly within the surface. Those
/// have steep gradients, whose errors grow with the square of the gradient.
inline Cases triplanar_normal_cases() {
    Cases c{.name = "triplanar object-space normals"};
    const real nan = std::numeric_limits<real>::quiet_NaN();
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V n = random.unit(), unit = normalize(n), w = reference::triplanar_weights<real>(n, 3);
        V sum{};
        real largest = 0;
        c.in("n", n), c.in("w", w);
        for (const char* plane : {"x_normal", "y_normal", "z_normal"}) {
            const V v = Random::rounded(normalize(unit + random.unit() * (hard ? random.magnitude(-3, 1) : 0.5L)) *
                                        (hard ? random.magnitude(-15, 15) : 1));
            const real weight = plane[0] == 'x' ? w.x : plane[0] == 'y' ? w.y : w.z;
            const V g = reference::surface_gradient_from_normal(unit, v);
            sum = sum + g * real{static_cast<float>(weight)};
            largest = std::max(largest, length(unit - g));
            c.in(plane, v);
        }
        c.add("triplanar object-space normals, seed " + std::to_string(seed), hard,
              std::max(real{1}, largest * largest));
        c.out("g", sum);
    }
    for (const V v : {V{}, V{1, 0, 0}, V{1e-45L, 0, 0}, V{0, 0, 3e38L}, V{3e38L, -3e38L, 0}}) {
        c.add("triplanar object-space normals, extreme", true);
        c.in("n", V{0, 0, 1}), c.in("w", V{0.5L, 0.25L, 0.25L});
        for (const char* plane : {"x_normal", "y_normal", "z_normal"}) c.in(plane, v);
        c.out("g", is_zero(v) || v.z > 0 ? V{} : V{nan, 0, 0});
    }
    return c;
}

/// Slopes of any size, and the first component of the normal that each makes.
inline Cases normal_offset_cases() {
    Cases c{.name = "normal offsets"};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V v = Random::rounded(random.unit() * (hard ? random.magnitude(-30, 38) : random.uniform(0, 3)));
        const V m = reference::tangent_normal_from_slope(V2{v.x, v.y});
        c.add("normal offset, seed " + std::to_string(seed), hard);
        c.in("slope", V2{v.x, v.y}), c.out("offset", V2{-m.x, -m.y});
    }
    return c;
}

}  // namespace wrinkle::cases
