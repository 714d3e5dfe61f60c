#pragma once

#include "tests/reference/cellular.h"
#include "tests/reference/fractal.h"
#include "tests/reference/simplex.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

/// The noise of a layer at the lattice coordinates of one octave.
template <class T>
OctaveNoise<T> octave_noise(const NoiseLayer& layer) {
    if (layer.type == NoiseType::worley) {
        const Cell cell = static_cast<Cell>(layer.feature);
        return [=](int, Vec<T> p) { return worley_noise(p, cell); };
    }
    if (layer.type == NoiseType::simplex)
        return [=](int octave, Vec<T> p) {
            const T grown = std::pow(T(layer.lacunarity), T(octave));
            const Vec<T> period{layer.period[0] * grown, layer.period[1] * grown, layer.period[2] * grown};
            return simplex_noise(p, period, T(layer.rotation));
        };
    return [cubic = layer.type == NoiseType::perlin1985](int, Vec<T> p) { return perlin_noise(p, cubic); };
}

/// Means of a layer's noise over space. They are measured; noise_test.cpp measures them again.
template <class T>
NoiseMeans<T> noise_means(const NoiseLayer& layer) {
    switch (layer.type) {
        case NoiseType::perlin:
            return perlin_means<T>();
        case NoiseType::perlin1985:
            return {0, T(0.2091L), T(0.0667L), T(0.3990L), T(0.0771L), T(0.0227L), 0, T(0.37L)};
        case NoiseType::simplex:
            return {0, T(0.3156L), T(0.1442L), T(2.4671L), T(0.6802L), T(0.2741L), 0, 1};
        case NoiseType::worley:
            break;
    }
    if (layer.feature == CellFeature::f1)
        return {T(0.5199L), T(0.5199L), T(0.3000L), T(0.3333L), T(0.1734L), T(0.1002L), T(0.5L), 0};
    if (layer.feature == CellFeature::f2)
        return {T(0.7165L), T(0.7165L), T(0.5337L), T(0.3333L), T(0.2390L), T(0.1781L), T(0.9L), 0};
    return {T(0.1965L), T(0.1965L), T(0.0637L), T(0.7536L), T(0.1460L), T(0.0467L), T(0.93L), 0};
}

}  // namespace wrinkle::reference
