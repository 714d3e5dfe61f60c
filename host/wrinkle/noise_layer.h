#pragma once

#include <array>
#include <optional>

/// Noise as a bump.
///
///     grain.bump = wrinkle::NoiseLayer{.frequency = 20, .octaves = 4};
///
/// Threads: values, used as any other: read by several at once, or changed by one.
namespace [[gnu::visibility("default")]] wrinkle {

enum class NoiseType { perlin, perlin1985, simplex, worley };
enum class CellFeature { f1, f2, f2_f1 };  ///< distance to the nearest point, to the second nearest, their difference
enum class FractalKind { sum, turbulence, ridged };
enum class NoiseGradient { analytic, forward, central };  ///< exact, or by differences of values, to compare

/// What is composed with noise f: first the remap, then one of the others at most.
struct NoiseShape {
    std::optional<std::array<double, 2>> remap;       ///< brings the first to 0 and the second to 1
    std::optional<double> power;                      ///< f^power, 1 at least; 0 for f below 0
    std::optional<std::array<double, 2>> smoothstep;  ///< from 0 at the first to 1 at the second
    std::optional<double> bias;                       ///< what 1/2 becomes, in (0,1); f in [0,1]
};

/// Noise in world space, a fractal of octaves gain^i noise(frequency lacunarity^i p).
struct NoiseLayer {
    static constexpr const char* kind = "noise";
    double frequency = 1;  ///< lattice cells per metre of the first octave
    int octaves = 1;       ///< at most; those that are too fine for a pixel to show are not evaluated
    double lacunarity = 2, gain = 0.5;
    NoiseType type = NoiseType::perlin;
    CellFeature feature = CellFeature::f1;  ///< worley
    FractalKind fractal = FractalKind::sum;
    double offset = 1, feedback = 2;        ///< ridged: height of the ridges; weight of an octave on the next
    std::array<double, 3> period{0, 0, 0};  ///< simplex: whole cells of the first octave at which an axis repeats, or 0
    double rotation = 0;                    ///< simplex: radians by which gradients are turned, flow noise
    NoiseGradient gradient = NoiseGradient::analytic;
    NoiseShape shape{};
};

}  // namespace wrinkle
