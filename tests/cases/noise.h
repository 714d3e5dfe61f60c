#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/fractal.h"

namespace wrinkle::cases {

/// Perlin noise: golden rows, cells all over the lattice up to 2^22, their faces, edges and corners.
inline Cases noise_cases() {
    Cases c{.name = "perlin2002_demo_dnoise"};
    const auto answer = [&](V p) {
        const auto n = reference::perlin_noise(p);
        c.in("p", p);
        c.out("value", n.value), c.out("gradient", n.gradient);
    };
    const GoldenTable table = reference::golden("perlin2002_demo_dnoise");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(table.vec(i, "p"));
        c.want["value"].back().x = table.number(i, "want_n");
        c.want["gradient"].back() = table.vec(i, "want_g");
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        V p = Random::rounded(random.box(1) * random.magnitude(-6, 6.6L));
        if (seed % 3 == 0) p.x = std::floor(p.x);
        if (seed % 7 == 0) p.y = std::ceil(p.y);
        if (seed % 11 == 0) p = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
        if (seed % 13 == 0) p.z = -1e-12L;
        p = Random::rounded(p);
        c.add("noise, seed " + std::to_string(seed), true);
        answer(p);
    }
    return c;
}

constexpr int fractal_octaves = 8;

/// Fractal sums seen from an eye far from the origin, with and without a footprint. Constants of a row: the gain, then
/// 4 numbers an octave, the eye on its lattice and the frequency.
inline Cases fractal_cases() {
    Cases c{.name = "fractal sums"};
    c.data.constants_per_row = 1 + 4 * fractal_octaves;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const real lacunarity = seed % 4 == 0 ? 0.5L : seed % 4 == 1 ? random.uniform(1.5L, 2.5L) : 2;
        const reference::Fractal<real> f{random.magnitude(-1, 1), fractal_octaves, lacunarity, 0.5L};
        const V eye = random.box(1000), p = random.box(3);
        const real footprint = seed % 2 ? 0 : random.magnitude(-3, 0);
        c.add("fractal, seed " + std::to_string(seed), seed % 4 != 2);
        c.in("p", p), c.in("footprint", footprint);
        const V want = reference::fractal_sum(f, eye + p, footprint).gradient;
        // Of each octave that is added: the noise's bound times frequency and gain, and half an ulp of the
        // lattice coordinate (< 512) times the largest second derivative.
        real size = 0;
        c.data.constants.push_back(static_cast<double>(f.gain));
        real frequency = f.frequency, amplitude = 1;
        for (int i = 0; i < fractal_octaves; ++i, frequency *= lacunarity, amplitude *= f.gain) {
            for (const real e : {eye.x, eye.y, eye.z}) {
                const real at = e * frequency;
                c.data.constants.push_back(static_cast<double>(at - 256 * std::floor(at / 256)));
            }
            c.data.constants.push_back(static_cast<double>(frequency));
            size += amplitude * frequency * reference::octave_weight(footprint * frequency);
        }
        c.allowance.back() = std::max(size, real{1e-30L});
        c.out("gradient", want);
    }
    return c;
}

}  // namespace wrinkle::cases
