#include <fmt/format.h>

#include <cmath>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {

constexpr double kPairs = 110;  // expected operations more, of an octave

/// Expected operations of an octave.
double octave_cost(const NoiseLayer& l) {
    const double once = l.type == NoiseType::simplex ? 320 : l.type == NoiseType::worley ? 900 : 260;
    const double value = l.type == NoiseType::simplex ? 260 : l.type == NoiseType::worley ? 880 : 130;
    return l.gradient == NoiseGradient::analytic ? once : l.gradient == NoiseGradient::forward ? 4 * value : 6 * value;
}

std::string basis(const NoiseLayer& l) {
    switch (l.type) {
        case NoiseType::perlin:
            return "WR_PERLIN";
        case NoiseType::perlin1985:
            return "WR_PERLIN1985";
        case NoiseType::simplex:
            return "WR_SIMPLEX";
        case NoiseType::worley:
            break;
    }
    const char* const features[] = {"WR_F1", "WR_F2", "WR_F2_F1"};
    return fmt::format("WR_WORLEY + {}", features[static_cast<int>(l.feature)]);
}

/// The noise as kernel text: a wr_noise whose members are constants.
std::string noise_text(const NoiseLayer& l) {
    const char* const gradients[] = {"WR_ANALYTIC", "WR_FORWARD", "WR_CENTRAL"};
    std::string text = fmt::format(".basis = {}, .gradient = {}", basis(l), gradients[static_cast<int>(l.gradient)]);
    if (l.type == NoiseType::simplex) {
        text += fmt::format(", .simplex = {{{{{}, {}, {}}}, {}}}", literal(l.period[0]), literal(l.period[1]),
                            literal(l.period[2]), l.rotation != 0 ? 1 : 0);
        if (l.rotation != 0)
            text +=
                fmt::format(", .cosine = {}, .sine = {}", literal(std::cos(l.rotation)), literal(std::sin(l.rotation)));
    }
    return "{" + text + "}";
}

/// The fractal as kernel text, likewise.
std::string fractal_text(const NoiseLayer& l, bool pairs) {
    const char* const kinds[] = {"WR_SUM", "WR_TURBULENCE", "WR_RIDGED"};
    std::string text = fmt::format(".noise = {}, .kind = {}, .octaves = {}, .gain = {}", noise_text(l),
                                   kinds[static_cast<int>(l.fractal)], l.octaves, literal(l.gain));
    if (pairs) text += ", .pairs = 1";
    if (l.type == NoiseType::simplex) text += fmt::format(", .lacunarity = {}", literal(l.lacunarity));
    if (l.fractal == FractalKind::ridged)
        text += fmt::format(", .offset = {}, .feedback = {}", literal(l.offset), literal(l.feedback));
    return "(wr_fractal){" + text + "}";
}

/// Statements that compose f with the shape.
std::string shape_text(const NoiseShape& shape) {
    std::string text;
    const auto apply = [&](const char* name, const std::string& numbers) {
        text += fmt::format("        f = wr_shape_{}(f, {});\n", name, numbers);
    };
    const auto pair = [](const std::array<double, 2>& v) { return literal(v[0]) + ", " + literal(v[1]); };
    if (shape.remap) apply("remap", pair(*shape.remap));
    if (shape.power) apply("power", literal(*shape.power));
    if (shape.smoothstep) apply("smoothstep", pair(*shape.smoothstep));
    if (shape.bias) apply("bias", literal(*shape.bias));
    return text;
}

/// In how many cells octave `i` repeats on each axis: what its lattice origin may be reduced by.
Periods lattice_period(const NoiseLayer& l, int i) {
    if (l.type != NoiseType::simplex) return 256;
    Vec3 period{};
    for (std::size_t k = 0; k < 3; ++k) period[k] = l.period[k] > 0 ? l.period[k] * std::pow(l.lacunarity, i) : 289;
    return Periods(period);
}

/// Adds the origins of all octaves, or what floats leave of them; gives the number of the first.
std::size_t add_lattice(Emitter& emitter, const NoiseLayer& l, const NoiseSpace& space, bool low) {
    double frequency = l.frequency;
    const std::size_t first = emitter.plan.origins.size();
    for (int i = 0; i < l.octaves; ++i, frequency *= l.lacunarity) {
        Origin origin{.period = lattice_period(l, i), .fourth = frequency, .low = low};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t j = 0; j < 3; ++j) origin.axes[k][j] = frequency * space.axes[k][j];
            origin.offset[k] = frequency * space.offset[k];
        }
        emitter.origin(origin);
    }
    return first;
}

}  // namespace

std::string noise_over(LayerText& at, const NoiseLayer& l, const NoiseSpace& space) {
    const std::size_t first = add_lattice(at.emitter, l, space, false);
    at.section.reads.insert("p");
    if (at.layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    at.section.operations += octave_cost(l) * l.octaves;
    const bool pairs =
        std::holds_alternative<NoiseLayer>(at.layer.bump) && at.emitter.precision(at.layer) == Precision::exact;
    std::string points = fmt::format("{},\n            origins + {}", space.point, 4 * first);
    if (pairs) {
        at.section.reads.insert("p_low");
        at.section.operations += kPairs * l.octaves;
        points = fmt::format("p, p_low,\n            origins + {}, origins + {}", 4 * first,
                             4 * add_lattice(at.emitter, l, space, true));
    }
    return fmt::format("        wr_field f = wr_fractal_at({}, {}, {}, {});\n", fractal_text(l, pairs), points,
                       at.layer.footprint ? space.footprint : "(wr_real)(0)", space.active) +
           shape_text(l.shape);
}

std::string emit(LayerText& at, const NoiseLayer& l) { return noise_over(at, l, {}) + at.volume("f.gradient"); }

}  // namespace wrinkle
