#pragma once

#include <fmt/format.h>

#include <functional>

#include "tests/cases/cases.h"
#include "tests/reference/fractal.h"
#include "tests/reference/shape.h"

namespace wrinkle::cases {

constexpr int fractal_octaves = 8;

/// Fractals of Perlin's noise, seen by an eye far from the origin, with and without a footprint. The constants of a row
/// are 4 numbers for each of 16 octaves (the eye's position on the octave's lattice, the frequency), then gain and
/// octaves, and for ridged ones offset and feedback. Rows near a kink of the function are left out.
inline Cases fractal_cases(reference::Octaves kind) {
    using reference::Octaves;
    Cases c{.name = "fractals of noise"};
    c.data.constants_per_row = 4 * 16 + (kind == Octaves::ridged ? 4 : 2);
    const auto means = reference::perlin_means<real>();
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        reference::Fractal<real> f{random.magnitude(-1, 1), fractal_octaves, 2, 0.5L, kind};
        if (seed % 4 == 0) f.lacunarity = 0.5L;
        if (seed % 4 == 1) f.lacunarity = random.uniform(1.5L, 2.5L);
        const V eye = random.box(1000), p = random.box(3);
        const real footprint = seed % 2 ? 0 : random.magnitude(-3, 0);
        // The documented bounds are for octaves that are added, whose amplitudes times frequencies sum up to 1. An
        // octave's error is that of the noise itself, and half an ulp of the lattice coordinate (< 512) times the
        // second derivative.
        real size = 0, frequency = f.frequency, amplitude = 1, nearest = 1;
        std::vector<double> lattice;
        for (int i = 0; i < fractal_octaves; ++i, frequency *= f.lacunarity, amplitude *= f.gain) {
            for (const real e : {eye.x, eye.y, eye.z})
                lattice.push_back(static_cast<double>(e * frequency - 256 * std::floor(e * frequency / 256)));
            lattice.push_back(static_cast<double>(frequency));
            const real weight = reference::octave_weight(means, footprint * frequency);
            size += amplitude * frequency * weight;
            if (weight > 0) nearest = std::min(nearest, std::abs(reference::perlin_noise((eye + p) * frequency).value));
        }
        if (kind != Octaves::sum && nearest < 3e-4L) continue;
        c.add(fmt::format("fractal, seed {}", seed), seed % 4 != 2, std::max(size, 1e-3L));
        c.in("p", p), c.in("footprint", footprint);
        lattice.resize(4 * 16);
        lattice.insert(lattice.end(), {static_cast<double>(f.gain), fractal_octaves});
        if (kind == Octaves::ridged) lattice.insert(lattice.end(), {1, 2});
        c.data.constants.insert(c.data.constants.end(), lattice.begin(), lattice.end());
        const auto noise = [](int, V q) { return reference::perlin_noise(q); };
        const auto want = reference::fractal<real>(f, noise, means, eye + p, footprint);
        c.out("value", want.value), c.out("gradient", want.gradient);
    }
    return c;
}

/// Values within 0 to 1, at the ends and beyond, with gradients of any size. `constants`: the numbers of the shape.
/// `unsure`: by which factor the error at a value may be larger.
template <class Shape>
Cases shape_cases(
    const std::vector<double>& constants, const Shape& shape,
    const std::function<real(real)>& unsure = [](real) { return real{1}; }) {
    Cases c{.name = "shapes"};
    c.data.constants = constants;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const bool hard = seed > 120;
        const real edges[] = {0, 1, 1e-12L, -1e-12L, 1 - 1e-7L, -2, 2, 0.5L};
        const real value = static_cast<float>(hard ? edges[seed % 8] : random.uniform(-0.25L, 1.25L));
        const V slope = Random::rounded(random.box(random.magnitude(hard ? -10 : -1, hard ? 10 : 1)));
        c.add(fmt::format("shape, seed {}", seed), hard, unsure(value));
        c.in("f", value), c.in("df_dp", slope);
        const auto want = shape(reference::NoiseValue<real>{value, slope});
        c.out("g", want.value), c.out("dg_dp", want.gradient);
    }
    return c;
}

}  // namespace wrinkle::cases
