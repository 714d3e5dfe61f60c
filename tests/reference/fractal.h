#pragma once

#include "tests/reference/noise.h"

namespace wrinkle::reference {

template <class T>
struct Fractal {
    T frequency = 1;
    int octaves = 1;
    T lacunarity = 2, gain = T(1) / 2;
};

/// Share of an octave that `cells` lattice cells per pixel leave: 1 up to a quarter, 0 from a half (Nyquist) on.
template <class T>
T octave_weight(T cells) {
    return saturate(2 - 4 * cells);
}

/// Fractal sum [Perlin 1985] of gain^i noise(frequency lacunarity^i p) with octaves above the footprint's Nyquist
/// frequency faded out. `footprint`: longest of |dp/dx|, |dp/dy|; 0 keeps every octave.
template <class T>
NoiseValue<T> fractal_sum(const Fractal<T>& f, Vec<T> p, T footprint) {
    NoiseValue<T> sum;
    T frequency = f.frequency, amplitude = 1;
    for (int i = 0; i < f.octaves; ++i) {
        const T weight = amplitude * octave_weight(footprint * frequency);
        if (weight != 0) {
            const NoiseValue<T> n = perlin_noise(p * frequency);
            sum.value += weight * n.value;
            sum.gradient = sum.gradient + n.gradient * (weight * frequency);
        }
        frequency *= f.lacunarity;
        amplitude *= f.gain;
    }
    return sum;
}

}  // namespace wrinkle::reference
