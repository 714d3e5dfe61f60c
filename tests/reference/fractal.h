#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/reference/noise.h"

namespace wrinkle::reference {

/// Means over space of a noise n, of |n| and of n^2.
template <class T>
struct NoiseMeans {
    T value{}, magnitude{}, square{};
    T slope{}, magnitude_slope{},
        square_slope{};       ///< of g^2, |n| g^2 and n^2 g^2; g^2: a third of the gradient's square
    T fade{}, fade_square{};  ///< by which octaves fade in a pixel: octave_weight
};

enum class Octaves { sum, turbulence, ridged };

template <class T>
struct Fractal {
    T frequency = 1;
    int octaves = 1;
    T lacunarity = 2, gain = T(1) / 2;
    Octaves kind = Octaves::sum;
    T offset = 1, feedback = 2;
};

/// The noise of an octave, as a function of lattice coordinates.
template <class T>
using OctaveNoise = std::function<NoiseValue<T>(int octave, Vec<T> p)>;

/// How much of an octave remains when a pixel spans so many of its lattice cells. It stands for the regression of the
/// gradient's mean over the pixel on the gradient in its middle, which noise_test.cpp measures.
template <class T>
T octave_weight(const NoiseMeans<T>& means, T cells) {
    const T left = saturate(1 - cells * (means.fade + cells * means.fade_square));
    return left * left;
}

/// Fractals of noise with octaves that are fine beside the footprint faded to their means, and with |n| as its
/// mean over the pixel. Sum and turbulence: Perlin 1985, of n and |n|; ridged multifractal: Musgrave, in Ebert et al.,
/// "Texturing and Modeling", 2003. `footprint`: longest of |dp/dx|, |dp/dy|; 0 keeps every octave. The gradient is that
/// of a constant footprint.
template <class T>
NoiseValue<T> fractal(const Fractal<T>& f, const OctaveNoise<T>& noise, const NoiseMeans<T>& means, Vec<T> p,
                      T footprint) {
    NoiseValue<T> sum, previous{1, {}};
    T frequency = f.frequency, amplitude = 1;
    for (int i = 0; i < f.octaves; ++i) {
        const T share = octave_weight(means, footprint * frequency);
        NoiseValue<T> n = noise(i, p * frequency);
        n.gradient = n.gradient * frequency;
        T mean = means.value;
        if (f.kind != Octaves::sum) {
            // |n| as the mean of |n + d| over d in [-range, range]: its primitive is d |d| / 2.
            const T range = footprint * length(n.gradient) / 2;  // half of that across the pixel
            const auto primitive = [](T d) { return d * std::abs(d) / 2; };
            const T sign = range > 0 ? std::clamp(n.value / range, T(-1), T(1)) : T((n.value > 0) - (n.value < 0));
            const T magnitude =
                range > 0 ? (primitive(n.value + range) - primitive(n.value - range)) / (2 * range) : std::abs(n.value);
            mean = means.magnitude;
            if (f.kind == Octaves::ridged) {
                n.gradient = n.gradient * (2 * n.value - 2 * f.offset * sign);
                n.value = f.offset * f.offset - 2 * f.offset * magnitude + n.value * n.value + range * range / 3;
                mean = f.offset * f.offset - 2 * f.offset * means.magnitude + means.square;
            } else {
                n = {magnitude, n.gradient * sign};
            }
        }
        n = {share * n.value + (1 - share) * mean, n.gradient * share};
        if (f.kind == Octaves::ridged) {
            n = {n.value * previous.value, n.gradient * previous.value + previous.gradient * n.value};
            const T next = f.feedback * n.value;
            previous =
                next > 0 && next < 1 ? NoiseValue<T>{next, n.gradient * f.feedback} : NoiseValue<T>{saturate(next), {}};
        }
        sum = {sum.value + amplitude * n.value, sum.gradient + n.gradient * amplitude};
        frequency *= f.lacunarity;
        amplitude *= f.gain;
    }
    return sum;
}

/// The means of Perlin's noise of 2002.
template <class T>
NoiseMeans<T> perlin_means() {
    return {0, T(0.2204L), T(0.0731L), T(0.4999L), T(0.0996L), T(0.0301L), 0, T(0.435L)};
}

/// The fractal sum of Perlin's noise of 2002.
template <class T>
NoiseValue<T> fractal_sum(const Fractal<T>& f, Vec<T> p, T footprint) {
    return fractal<T>(
        f, [](int, Vec<T> q) { return perlin_noise(q); }, perlin_means<T>(), p, footprint);
}

}  // namespace wrinkle::reference
