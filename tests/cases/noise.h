#pragma once

#include <fmt/format.h>

#include "tests/cases/cases.h"
#include "tests/reference/cellular.h"
#include "tests/reference/simplex.h"

namespace wrinkle::cases {

/// A row of a noise at lattice coordinates.
inline void add_noise(Cases& c, const std::string& label, bool hard, V p, const reference::NoiseValue<real>& want) {
    c.add(label, hard);
    c.in("p", p);
    c.out("value", want.value), c.out("gradient", want.gradient);
}

/// Calls `add` for points. Regular ones lie near the origin; hard ones up to `far`, and on faces, edges and corners of
/// cells.
template <class Add>
void each_lattice_point(real far, const Add& add) {
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const bool hard = seed > 100;
        V p = random.box(hard ? std::min(far, random.magnitude(-6, std::log10(far))) : 40);
        if (hard && seed % 3 == 0) p.x = std::floor(p.x);
        if (hard && seed % 7 == 0) p.y = std::ceil(p.y);
        if (hard && seed % 11 == 0) p = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
        if (hard && seed % 13 == 0) p.z = -1e-12L;
        add(fmt::format("noise, seed {}", seed), hard, Random::rounded(p));
    }
}

/// Perlin's noise of 2002, with the golden rows; with `cubic`, that of 1985.
inline Cases perlin_cases(bool cubic) {
    Cases c{.name = cubic ? "perlin1985" : "perlin2002_demo_dnoise"};
    if (!cubic) {
        const GoldenTable table = reference::golden(c.name);
        for (std::size_t i = 0; i < table.size(); ++i)
            add_noise(c, c.name + ": " + table.label(i), table.text(i, "set") == "hard", table.vec(i, "p"),
                      {table.number(i, "want_n"), table.vec(i, "want_g")});
    }
    each_lattice_point(4e6L, [&](const std::string& label, bool hard, V p) {
        add_noise(c, label, hard, p, reference::perlin_noise(p, cubic));
    });
    return c;
}

/// Simplex noise: golden rows, then points up to 1e6 with periods up to `longest_period`. The constants of a row are
/// its periods and its angle.
inline Cases simplex_cases(int longest_period) {
    Cases c{.name = "psrdnoise3_glsl"};
    c.data.constants_per_row = 4;
    const auto constants = [&](V period, real angle) {
        for (const real v : {period.x, period.y, period.z, angle}) c.data.constants.push_back(static_cast<double>(v));
    };
    const GoldenTable table = reference::golden(c.name);
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_noise(c, c.name + ": " + table.label(i), table.text(i, "set") == "hard", table.vec(i, "x"),
                  {table.number(i, "want_n"), table.vec(i, "want_g")});
        constants(table.vec(i, "period"), table.number(i, "alpha"));
    }
    each_lattice_point(1e6L, [&](const std::string& label, bool hard, V p) {
        Random random(static_cast<unsigned>(c.size()));
        const V period{real(random.below(3) * random.below(100)), real(random.below(longest_period)),
                       real(random.below(9))};
        const real angle = random.below(2) * random.uniform(-7, 7);
        add_noise(c, label, hard, p, reference::simplex_noise(p, period, angle));
        constants(period, angle);
    });
    return c;
}

/// Points around which the gradient does not jump within `margin`. The direction to a feature point is only as exact as
/// the point's coordinates: the documented bounds hold at 0.1 cells and more, and larger errors are allowed nearer by.
inline Cases worley_cases(reference::Cell feature, real margin = 1e-5L) {
    Cases c{.name = "worley"};
    each_lattice_point(4e6L, [&](const std::string& label, bool hard, V p) {
        if (reference::distance_to_jump(p, feature) <= margin) return;
        add_noise(c, label, hard, p, reference::worley_noise(p, feature));
        c.allowance.back() = std::max(real{1}, 0.1L / reference::worley_noise(p, reference::Cell::f1).value);
    });
    return c;
}

/// Points whose second nearest feature point lies outside of the 27 cells around them, which is so for 1 in 5000 of the
/// points near a face.
inline Cases worley_search_cases() {
    Cases c{.name = "worley, where 27 cells are not enough"};
    for (const V p : {V{132.078125L, -91.1875L, -143.0078125L}, V{116.359375L, 43.21875L, -197.9921875L},
                      V{-73.96875L, 145.0L, 153.0078125L}, V{54.265625L, -87.8125L, -43.9921875L},
                      V{-94.015625L, 125.234375L, -97.0078125L}, V{-78.0L, -35.359375L, 156.0078125L},
                      V{-5.515625L, 92.953125L, -4.0078125L}, V{154.03125L, 197.40625L, -13.9921875L},
                      V{-155.28125L, 82.765625L, -6.0078125L}, V{24.234375L, 137.625L, -30.0078125L},
                      V{-8.09375L, -42.78125L, -130.9921875L}, V{95.40625L, 62.109375L, 144.0078125L}})
        add_noise(c, fmt::format("point {}", c.size()), true, p, reference::worley_noise(p, reference::Cell::f2));
    return c;
}

}  // namespace wrinkle::cases
