#pragma once

#include "tests/cases/surface_derivatives.h"
#include "tests/reference/resolve.h"
#include "tests/reference/vertex_frame.h"

namespace wrinkle::cases {

/// Frames of interpolated tangents: golden rows of listing 9, then vectors of any length and angle.
inline Cases vertex_frame_cases() {
    Cases c{.name = "listing09_prologue"};
    const auto in = [&](V n, V tangent, real sign) {
        c.in("n", n), c.in("tangent", tangent), c.in("tangent_sign", sign);
    };
    const GoldenTable table = reference::golden("listing09_prologue");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        in(table.vec(i, "In_n"), table.vec(i, "In_t"), table.number(i, "In_t.w"));
        c.out("T", table.vec(i, "want_mT")), c.out("B", table.vec(i, "want_mB"));
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit(), side = normalize(cross(n, random.unit()));
        const V tangent = side + n * random.uniform(-1, 1);
        const V normal = Random::rounded(n * random.magnitude(-15, 15));
        const V along = Random::rounded(tangent * random.magnitude(-15, 15));
        const real sign = seed % 3 == 0 ? 0 : random.uniform(-1, 1);
        c.add("vertex frame, any length, seed " + std::to_string(seed), true);
        in(normal, along, sign);
        const auto frame = reference::vertex_frame(normal, along, sign);
        c.out("T", frame.tangent), c.out("B", frame.bitangent);
    }
    c.add("vertex frame of no normal", true);
    in({}, {1, 2, 3}, 1);
    c.out("T", V{}), c.out("B", V{});
    for (const real size : {1e-38L, 3e38L}) {  // any finite answer will do
        c.add("vertex frame beyond floats", true);
        in({size, -size, size}, V{3e38L, 3e38L, -3e38L}, -1);
        c.out("T", V{NAN, NAN, NAN}), c.out("B", V{NAN, NAN, NAN});
    }
    return c;
}

/// Two-sided normals: golden rows of listing 9, then normals of any length.
inline Cases two_sided_cases() {
    Cases c{.name = "listing09_prologue n"};
    const GoldenTable table = reference::golden("listing09_prologue");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        c.in("n", table.vec(i, "In_n")), c.in("flip", table.number(i, "isFlip"));
        c.out("normal", table.vec(i, "want_n"));
    }
    for (unsigned seed = 1; seed <= 100; ++seed) {
        Random random(seed);
        const V n = seed == 1 ? V{} : Random::rounded(random.unit() * random.magnitude(-34, 37));
        c.add("two sides, seed " + std::to_string(seed), true);
        c.in("n", n), c.in("flip", seed % 2);
        c.out("normal", normalize(n) * real(seed % 2 ? -1 : 1));
    }
    return c;
}

/// Normals at any angle to the view, but none so near a right angle that rounding decides whether they face it.
inline Cases facing_cases() {
    Cases c{.name = "facing normal"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const V n = random.unit(), side = normalize(cross(n, random.unit()));
        const real cosine = random.magnitude(-5, 0) * (seed % 2 ? 1 : -1);
        const V p = Random::rounded((side + normalize(n) * cosine) * random.magnitude(-15, 15));
        c.add("facing, seed " + std::to_string(seed), std::abs(cosine) < 0.01L);
        c.in("n", n), c.in("p", p);
        const V unit = normalize(n), v = normalize(p) * real(-1);
        c.out("normal", reference::face_viewer(unit, v));
        c.out("reflected", real(dot(unit, v) < 0 ? 1 : 0));
    }
    return c;
}

/// Derivatives moved onto a base normal: golden rows of listing 9, then footprints of any size that are far from
/// tangent to it.
inline Cases rebase_cases() {
    Cases c{.name = "listing09_prologue sigma"};
    const auto answer = [&](V n, V dp_dx, V dp_dy) {
        c.in("n", n), c.in("dp_dx", dp_dx), c.in("dp_dy", dp_dy);
        const V unit = normalize(n);
        const auto tangent = [&](V a) { return cross(unit, cross(a, unit)); };
        c.out("sigma_x", tangent(dp_dx)), c.out("sigma_y", tangent(dp_dy));
        c.out("flip_sign", reference::flip_sign(unit, dp_dx, dp_dy));
    };
    const GoldenTable table = reference::golden("listing09_prologue");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        const V n = normalize(table.vec(i, "In_n")) * real(table.number(i, "isFlip") != 0 ? -1 : 1);
        answer(Random::rounded(n), table.vec(i, "dPdx"), table.vec(i, "dPdy"));
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        const real size = length(d.dp_dx);
        d.dp_dx = Random::rounded(d.dp_dx + d.n * (size * random.magnitude(-3, 3)));
        d.dp_dy = Random::rounded(d.dp_dy - d.n * (size * random.magnitude(-3, 3)));
        c.add("rebase, any footprint, seed " + std::to_string(seed), true);
        answer(d.n, d.dp_dx, d.dp_dy);
    }
    return c;
}

}  // namespace wrinkle::cases
