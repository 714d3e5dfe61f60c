#include <fmt/format.h>

#include <cmath>

#include "plan/noise_text.h"

namespace wrinkle {

namespace {

constexpr double kPairs = 110;  // expected additional operations of an octave

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

/// Kernel text of the numbers of a noise.
class NoiseNumbers {
public:
    NoiseNumbers(LayerText& at, const NoiseOf& of) : at_(at), of_(of) {}

    std::string operator()(const std::string& what, double (*value)(const NoiseLayer&)) const {
        return at_.number(what, [of = of_, value](const Layer& layer) { return value(of(layer)); });
    }
    /// Two numbers, with a comma between.
    std::string pair(const std::string& what, const std::array<double, 2>& (*value)(const NoiseLayer&)) const {
        const std::size_t first =
            at_.emitter.numbers(at_.layer, what, [of = of_, value](const Layer& layer, const auto&) {
                const std::array<double, 2>& both = value(of(layer));
                return std::vector(both.begin(), both.end());
            });
        return fmt::format("numbers[{}], numbers[{}]", first, first + 1);
    }

private:
    LayerText& at_;
    const NoiseOf& of_;
};

/// Kernel text of a wr_noise. What chooses code is a constant; so is whether the noise repeats or flows, because one
/// that does neither then needs fewer operations.
std::string noise_text(LayerText& at, const NoiseLayer& l, const NoiseOf& of) {
    const char* const gradients[] = {"WR_ANALYTIC", "WR_FORWARD", "WR_CENTRAL"};
    std::string text = fmt::format(".basis = {}, .gradient = {}", basis(l), gradients[static_cast<int>(l.gradient)]);
    if (l.type == NoiseType::simplex) {
        std::string periods;
        for (std::size_t k = 0; k < 3; ++k)
            periods += (k ? ", " : "") +
                       (l.period[k] == 0 ? "0" : at.number(fmt::format("period[{}]", k), [of, k](const Layer& layer) {
                           return of(layer).period[k];
                       }));
        text += fmt::format(", .simplex = {{{{{}}}, {}}}", periods, l.rotation != 0 ? 1 : 0);
        const NoiseNumbers number(at, of);
        if (l.rotation != 0)
            text += fmt::format(", .cosine = {}, .sine = {}",
                                number("cosine of rotation", [](const NoiseLayer& n) { return std::cos(n.rotation); }),
                                number("sine of rotation", [](const NoiseLayer& n) { return std::sin(n.rotation); }));
    }
    return "{" + text + "}";
}

/// Kernel text of a wr_fractal.
std::string fractal_text(LayerText& at, const NoiseLayer& l, const NoiseOf& of, bool pairs) {
    const NoiseNumbers number(at, of);
    const char* const kinds[] = {"WR_SUM", "WR_TURBULENCE", "WR_RIDGED"};
    std::string text = fmt::format(".noise = {}, .kind = {}, .octaves = {}, .gain = {}", noise_text(at, l, of),
                                   kinds[static_cast<int>(l.fractal)], l.octaves,
                                   number("gain", [](const NoiseLayer& n) { return n.gain; }));
    if (pairs) text += ", .pairs = 1";
    if (l.type == NoiseType::simplex)
        text += ", .lacunarity = " + number("lacunarity", [](const NoiseLayer& n) { return n.lacunarity; });
    if (l.fractal == FractalKind::ridged)
        text += fmt::format(", .offset = {}, .feedback = {}",
                            number("offset", [](const NoiseLayer& n) { return n.offset; }),
                            number("feedback", [](const NoiseLayer& n) { return n.feedback; }));
    return "(wr_fractal){" + text + "}";
}

/// Statements that apply the shape to f.
std::string shape_text(LayerText& at, const NoiseShape& shape, const NoiseOf& of) {
    const NoiseNumbers number(at, of);
    std::string text;
    const auto apply = [&](const char* name, const std::string& numbers) {
        text += fmt::format("        f = wr_shape_{}(f, {});\n", name, numbers);
    };
    using Pair = const std::array<double, 2>&;
    if (shape.remap)
        apply("remap", number.pair("remap", [](const NoiseLayer& n) -> Pair { return n.shape.remap.value(); }));
    if (shape.power) apply("power", number("power", [](const NoiseLayer& n) { return n.shape.power.value(); }));
    if (shape.smoothstep)
        apply("smoothstep",
              number.pair("smoothstep", [](const NoiseLayer& n) -> Pair { return n.shape.smoothstep.value(); }));
    if (shape.bias) apply("bias", number("bias", [](const NoiseLayer& n) { return n.shape.bias.value(); }));
    return text;
}

/// Number of cells after which octave `i` repeats on each axis; its lattice origin is reduced modulo that.
Periods lattice_period(const NoiseLayer& l, int i) {
    if (l.type != NoiseType::simplex) return 256;
    Vec3 period{};
    for (std::size_t k = 0; k < 3; ++k) period[k] = l.period[k] > 0 ? l.period[k] * std::pow(l.lacunarity, i) : 289;
    return Periods(period);
}

/// The eye in the lattice of octave `i`, and the octave's frequency; if `low`, what these lose when rounded to float.
EyePlace octave_eye_place(const NoiseLayer& l, const NoiseAxes& space, int i, bool low) {
    double frequency = l.frequency;
    for (int octave = 0; octave < i; ++octave) frequency *= l.lacunarity;
    EyePlace origin{.period = lattice_period(l, i), .fourth = frequency, .low = low};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) origin.axes[k][j] = frequency * space.axes[k][j];
        origin.offset[k] = frequency * space.offset[k];
    }
    return origin;
}

/// Adds such an eye_place for every octave; returns the index of the first.
std::size_t add_lattice(LayerText& at, const NoiseLayer& l, const NoiseOf& of, const NoiseSpace& space, bool low) {
    const std::size_t first = at.emitter.plan.eye_places.size();
    for (int i = 0; i < l.octaves; ++i)
        at.emitter.eye_place(at.layer, [of, axes = space.axes, i, low](const Layer& layer) {
            return octave_eye_place(of(layer), axes(layer), i, low);
        });
    return first;
}

}  // namespace

std::string noise_over(LayerText& at, const NoiseOf& of, const NoiseSpace& space) {
    const NoiseLayer& l = of(at.layer);
    const std::size_t first = add_lattice(at, l, of, space, false);
    at.section.reads.insert("p");
    if (at.layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    at.section.operations += octave_cost(l) * l.octaves;
    std::string points = fmt::format("{},\n            eye_places + {}", space.point, 4 * first);
    if (space.pairs) {
        at.section.reads.insert("p_low");
        at.section.operations += kPairs * l.octaves;
        points = fmt::format("p, p_low,\n            eye_places + {}, eye_places + {}", 4 * first,
                             4 * add_lattice(at, l, of, space, true));
    }
    const bool spread = at.tells_spread(), area = at.over_area();
    std::string text = area ? "        wr_real lost;\n" : "";
    std::string walk;
    if (area && at.emitter.scene.filter.taps > 1) {
        // Each noise keeps the values of its octaves from point to point, because one point's value may serve others.
        // So values are computed wherever any point may want the layer, also where the mask's texture is 0 at this one.
        at.active_at_any_point = true;
        // A layer can have several noises: a triplanar has one for each plane.
        const std::string held = fmt::format("held_{}", 4 * first);
        at.declared += fmt::format("        wr_held {}[{}];\n", held, l.octaves);
        text += fmt::format("        wr_walk walk = {{tap, taps.count - (wr_real)((WR_SCALAR)tap), {}, {}}};\n",
                            space.step, held);
        walk = ", &walk, &lost";
    } else if (area) {
        walk = ", 0, &lost";
    }
    text += fmt::format("        wr_field f = wr_fractal_at({}, {}, {}, {}{});\n", fractal_text(at, l, of, space.pairs),
                        points, at.layer.footprint ? space.footprint : "(wr_real)(0)", space.active, walk);
    const std::string shape = shape_text(at, l.shape, of);
    if (!spread || shape.empty()) return text + shape;
    // A shape multiplies the gradient by its derivative. Applied to a gradient of 1 it gives the derivative itself,
    // which the lost variance needs too.
    return text +
           "        wr_vec3 noise_gradient = f.gradient;\n"
           "        f.gradient = wr_v3((wr_real)(1), (wr_real)(0), (wr_real)(0));\n" +
           shape +
           "        lost *= f.gradient.x * f.gradient.x;\n"
           "        f.gradient = wr_scale(noise_gradient, f.gradient.x);\n";
}

}  // namespace wrinkle
