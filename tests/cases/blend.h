#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/blend.h"

namespace wrinkle::cases {

/// Blends of tangent-space normals: golden rows, and random pairs of any steepness.
inline Cases blend_cases(const std::string& column, V (*blend)(V, V)) {
    Cases c{.name = "blend_tspace_normals " + column};
    const GoldenTable table = reference::golden("blend_tspace_normals");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {"a", "b"});
        c.out("normal", table.has(column + ".x") ? table.vec(i, column) : blend(c.vec(i, "a"), c.vec(i, "b")));
    }
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const auto normal = [&] {
            V m = random.unit();
            m.z *= random.magnitude(-6, 0);
            return Random::rounded(normalize(m));
        };
        const V a = normal(), b = normal(), want = normalize(blend(a, b));
        c.add("blend, seed " + std::to_string(seed), true);
        c.in("a", a), c.in("b", b), c.out("normal", want);
    }
    // Blends cancel: only a finite answer is asked for.
    for (const V a : {V{0, 0, 1}, V{0, 0, -1}, V{}, V{1, 0, 0}, V{-1, 0, 0}})
        for (const V b : {V{0, 0, 1}, V{0, 0, -1}, V{}, V{1, 0, 0}}) {
            c.add("blend of an extreme", true);
            c.in("a", a), c.in("b", b), c.out("normal", V{std::numeric_limits<real>::quiet_NaN(), 0, 0});
        }
    return c;
}

/// Rotations of a detail normal from n to a base normal, up to half a turn.
inline Cases reorient_cases() {
    Cases c{.name = "reoriented normals"};
    const auto add = [&](const std::string& label, bool hard, V n, V base, V detail) {
        const V s = normalize(n), t = normalize(base);
        c.add(label, hard, 1 / std::sqrt((1 + dot(s, t)) / 2));
        c.in("n", n), c.in("base", base), c.in("detail", detail);
        c.out("normal", reference::reorient(s, t, normalize(detail)));
    };
    const GoldenTable table = reference::golden("blend_tspace_normals");
    for (std::size_t i = 0; i < table.size(); ++i)
        add(c.name + ": " + table.label(i), table.text(i, "set") == "hard", table.vec(i, "vtx"), table.vec(i, "b"),
            table.vec(i, "a"));
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const V n = random.unit();
        const V base = Random::rounded(normalize(random.unit() * random.magnitude(-3, 1) - n));
        add("towards the opposite, seed " + std::to_string(seed), true, n, base, random.unit());
    }
    c.add("opposite normals", true);
    c.in("n", V{0, 0, 1}), c.in("base", V{0, 0, -1}), c.in("detail", V{0.5L, 0, 0.5L});
    c.out("normal", V{0.5L, 0, -0.5L});
    return c;
}

/// Blends of surface gradients tangent to n. Regular: slopes from 1e-6 to 10, which no limit touches. Hard: gradients
/// of any length, for which only a finite answer is asked. Where the terms of the sum cancel, a larger error is
/// allowed.
inline Cases combine_cases(reference::Blending how) {
    Cases c{.name = "combined gradients"};
    const auto add = [&](V n, V g, V detail) { c.in("n", n), c.in("g", g), c.in("detail", detail); };
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V n = random.unit(), unit = normalize(n);
        const auto tangent = [&] {
            const V v = random.unit();
            const real size = hard ? random.magnitude(-6, 1) : random.uniform(0.01L, 1);
            return Random::rounded(normalize(v - unit * dot(v, unit)) * size);
        };
        const V g = tangent(), detail = tangent(), want = combine_gradients(how, unit, g, detail);
        const bool rnm = how == reference::Blending::rnm;
        const real upright = 1 - dot(g, detail);  // RNM divides by it; negative: the result points inwards, no gradient
        const real steep = rnm ? (1 + length(g) * length(detail)) / upright / upright
                               : std::hypot(real{1}, length(g)) * std::hypot(real{1}, length(detail));
        const real terms = (length(g) + length(detail)) * steep;
        c.add("combined gradients, seed " + std::to_string(seed), hard, std::max(real{1}, terms / length(want)));
        c.angle_allowance.push_back(1);
        add(n, g, detail);
        const bool limited = rnm && upright < 0.2L;
        c.out("combined", limited ? V{std::numeric_limits<real>::quiet_NaN(), 0, 0} : want);
    }
    const real most = std::numeric_limits<float>::max();
    for (const V g : {V{}, V{most, -most, 0}, V{1e-45L, 0, 0}, V{0, 1e20L, 0}})
        for (const V detail : {V{}, V{0, most, 0}, V{-most, most, 0}, V{0, 1e-40L, 0}, V{-1e20L, 0, 0}}) {
            c.add("combined extremes", true);
            c.angle_allowance.push_back(1);
            add({0, 0, 1}, g, detail);
            c.out("combined", is_zero(g) && is_zero(detail) ? V{} : V{std::numeric_limits<real>::quiet_NaN(), 0, 0});
        }
    return c;
}

/// Perturbed normals mixed, by any share, with normals that range from the same to nearly the opposite.
inline Cases combine_towards_cases() {
    Cases c{.name = "mixed normals"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V n = random.unit(), unit = normalize(n), v = random.unit();
        const V g = Random::rounded(normalize(v - unit * dot(v, unit)) * random.magnitude(-6, hard ? 3 : 0));
        const V below = reference::resolve(unit, g);
        const V other = Random::rounded(normalize(hard ? random.unit() : below + random.unit() * 0.5L));
        const real weight = seed % 10 == 0 ? 0 : seed % 10 == 2 ? 1 : static_cast<float>(random.uniform(0, 1));
        c.add("mixed normals, seed " + std::to_string(seed), hard,
              1 / length(below * (1 - weight) + normalize(other) * weight));
        c.in("n", n), c.in("g", g), c.in("other", other), c.in("weight", weight);
        c.out("combined", weight == 0 ? g : reference::combine_towards(unit, g, normalize(other), weight));
    }
    return c;
}

}  // namespace wrinkle::cases
