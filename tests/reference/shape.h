#pragma once

#include <numbers>

#include "tests/reference/noise.h"

namespace wrinkle::reference {

/// g composed with f: value g(f), gradient g'(f) grad f [Mik20 4.6].
template <class T>
NoiseValue<T> composed(const NoiseValue<T>& f, T value, T slope) {
    return {value, f.gradient * slope};
}

template <class T>
NoiseValue<T> shape_remap(const NoiseValue<T>& f, T low, T high) {
    return composed(f, (f.value - low) / (high - low), 1 / (high - low));
}

template <class T>
NoiseValue<T> shape_ramp(const NoiseValue<T>& f, T low, T high) {
    const T t = (f.value - low) / (high - low);
    return composed(f, saturate(t), t > 0 && t < 1 ? 1 / (high - low) : T(0));
}

template <class T>
NoiseValue<T> shape_wave(const NoiseValue<T>& f, T low, T high) {
    const T turn = 2 * std::numbers::pi_v<T>, phase = turn * (f.value - low) / (high - low);
    return composed(f, std::sin(phase), turn * std::cos(phase) / (high - low));
}

/// Upstill 1989, dented(): a power.
template <class T>
NoiseValue<T> shape_power(const NoiseValue<T>& f, T exponent) {
    if (f.value <= 0) return {};
    return composed(f, std::pow(f.value, exponent), exponent * std::pow(f.value, exponent - 1));
}

template <class T>
NoiseValue<T> shape_smoothstep(const NoiseValue<T>& f, T low, T high) {
    const T t = saturate((f.value - low) / (high - low));
    return composed(f, t * t * (3 - 2 * t), 6 * t * (1 - t) / (high - low));
}

/// Schlick, "Fast Alternatives to Perlin's Bias and Gain Functions", Graphics Gems IV, 1994. The slope by the quotient
/// rule.
template <class T>
NoiseValue<T> shape_bias(const NoiseValue<T>& f, T bias) {
    const T t = saturate(f.value), c = 1 / bias - 2, below = c * (1 - t) + 1;
    return composed(f, t / below, f.value > 0 && f.value < 1 ? (below + t * c) / (below * below) : T(0));
}

}  // namespace wrinkle::reference
