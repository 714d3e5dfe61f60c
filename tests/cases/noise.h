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

/// Points near the origin, regular, and all over the lattice up to `far`, with their cells' faces, edges and corners.
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

/// Perlin's noise of 2002, with the golden rows, or of 1985.
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

/// Simplex noise: golden rows, then points up to 2^20. Constants of a row: its periods and its angle.
inline Cases simplex_cases() {
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
        const V period{real(random.below(3) * random.below(100)), real(random.below(1 << 20)), real(random.below(9))};
        const real angle = random.below(2) * random.uniform(-7, 7);
        add_noise(c, label, hard, p, reference::simplex_noise(p, period, angle));
        constants(period, angle);
    });
    return c;
}

/// Points whose gradient does not jump within `margin`.
inline Cases worley_cases(reference::Cell feature, real margin = 1e-5L) {
    Cases c{.name = "worley"};
    each_lattice_point(4e6L, [&](const std::string& label, bool hard, V p) {
        if (reference::distance_to_jump(p, feature) > margin)
            add_noise(c, label, hard, p, reference::worley_noise(p, feature));
    });
    return c;
}

/// Points whose second nearest feature point lies beyond the 27 cells around them: 1 in 5000 of those near a face.
inline Cases worley_search_cases() {
    Cases c{.name = "worley, where 27 cells are not enough"};
    for (const V p : {V{31.203125L, -184.09375L, -53.9921875L}, V{-183.90625L, 133.59375L, -25.0078125L},
                      V{51.328125L, 192.96875L, -75.9921875L}, V{38.953125L, 33.734375L, -197.9921875L},
                      V{-182.0625L, 151.96875L, -156.9921875L}, V{143.0L, -115.515625L, 183.9921875L},
                      V{-69.609375L, 63.828125L, -167.0078125L}, V{-77.953125L, 139.03125L, 87.0078125L},
                      V{124.703125L, 144.71875L, -15.0078125L}, V{76.046875L, 0.546875L, -187.0078125L},
                      V{-176.984375L, 49.984375L, 151.0078125L}, V{-3.265625L, -81.8125L, 186.0078125L}})
        add_noise(c, fmt::format("point {}", c.size()), true, p, reference::worley_noise(p, reference::Cell::f2));
    return c;
}

}  // namespace wrinkle::cases
