#include <fmt/format.h>

#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

namespace {

/// A noise. Its gradient can also be computed by differences.
struct Noise {
    const char *name, *basis, *file, *summary, *source;
    std::string note;
    double value, gradient, forward, central;  ///< largest errors
};

const std::vector<Noise>& noises() {
    const std::string near =
        "Compared further than 1e-5 (differences: 1e-2) from where the gradient jumps; nearer than 0.1 to a feature "
        "point, 0.1 / distance times that.";
    static const std::vector<Noise> all{
        {"perlin_noise", "WR_PERLIN", "sources/noise.clh", "Perlin's improved noise and its gradient; period 256",
         "Perlin 2002", "", 1e-6, 3e-6, 8e-3, 5e-4},
        {"perlin1985_noise", "WR_PERLIN1985", "sources/noise.clh",
         "Perlin's noise of 1985, cubic fade, and its gradient; period 256", "Perlin 1985",
         "The hash and the gradients are those of 2002.", 1e-6, 3e-6, 8e-3, 2e-2},
        {"simplex_noise", "WR_SIMPLEX", "sources/simplex.clh",
         "Simplex noise that tiles and flows, and its gradient; period 289 or as set", "Gustavson and McEwan 2021",
         "Points up to 2^20 cells from the origin.", 1e-6, 3e-6, 2e-2, 2e-3},
        {"worley_f1", "WR_WORLEY + WR_F1", "sources/cellular.clh",
         "Distance to the nearest feature point and its gradient; period 256", "Worley 1996", near, 1e-6, 1e-6, 5e-2,
         5e-3},
        {"worley_f2", "WR_WORLEY + WR_F2", "sources/cellular.clh",
         "Distance to the second nearest feature point and its gradient; period 256", "Worley 1996", near, 1e-6, 1e-6,
         5e-2, 5e-3},
        {"worley_f2_f1", "WR_WORLEY + WR_F2_F1", "sources/cellular.clh",
         "Difference of the distances to the two nearest feature points and its gradient; period 256", "Worley 1996",
         near, 1e-6, 2e-6, 5e-2, 5e-3},
    };
    return all;
}

/// A row of the table: a noise, with its gradient computed in one of the ways.
Function row(const Noise& noise, const char* suffix, const char* way, const char* gradient, double error,
             double fp64_error) {
    Function f{.name = std::string(noise.name) + suffix,
               .file = suffix[0] ? "sources/noise_family.clh" : noise.file,
               .summary = std::string(noise.summary) + way,
               .source = noise.source};
    f.parameters = {vector("p", "lattice cells", "point, up to 2^22 cells from the origin")};
    std::string simplex;
    if (std::string(noise.basis) == "WR_SIMPLEX") {
        f.settings = {
            {"period", Setting::Kind::vector, "cells at which each axis repeats; 0: 289", {0, 0, 0}, 0, 1 << 20, true},
            {"rotation", Setting::Kind::number, "radians by which gradients are turned", {0}}};
        simplex =
            ",\n    .simplex = {{wr_lane(period.x, 0), wr_lane(period.y, 0), wr_lane(period.z, 0)}, 1},"
            "\n    .cosine = cos(rotation), .sine = sin(rotation)";
    }
    f.results = {result(number("value", "1", "noise"), {absolute}),
                 result(vector("gradient", "per cell", "its gradient"), {absolute})};
    f.variants = {{standard,
                   fmt::format("wr_noise noise = {{.basis = {}, .gradient = {}{}}};\n"
                               "wr_field v = wr_noise_at(noise, p);\nvalue = v.value, gradient = v.gradient;",
                               noise.basis, gradient, simplex),
                   {noise.value, error}}};
    f.fp64_error = fp64_error;
    f.note = noise.note;
    return f;
}

/// A fractal of Perlin's noise.
Function fractal(const char* name, const char* kind, const char* summary, const char* source, double error) {
    Function f{.name = name, .file = "sources/fractal.clh", .summary = summary, .source = source};
    f.parameters = {vector("p", "metres", "position, relative to the eye"),
                    number("footprint", "metres", "longest side of the pixel's footprint; 0: every octave")};
    f.settings = {{"lattice", Setting::Kind::lattice, "frequency of the first octave, lacunarity", {1, 2}},
                  {"gain", Setting::Kind::number, "amplitude of an octave to that of the one before", {0.5}},
                  {"octaves", Setting::Kind::number, "octaves", {8}, 1, 16, true}};
    std::string ridged;
    if (std::string(kind) == "WR_RIDGED") {
        f.settings.push_back({"offset", Setting::Kind::number, "height of the ridges", {1}});
        f.settings.push_back({"feedback", Setting::Kind::number, "how much an octave weighs down the next", {2}});
        ridged = ", .offset = offset, .feedback = feedback";
    }
    f.results = {result(number("value", "1", "the fractal"), {absolute}),
                 result(vector("gradient", "per metre", "its gradient"), {absolute})};
    f.variants = {{standard,
                   fmt::format("wr_fractal f = {{.noise = {{.basis = WR_PERLIN}}, .kind = {}, .octaves = (int)octaves, "
                               ".gain = gain{}}};\n"
                               "wr_field v = wr_fractal_at(f, p, lattice, footprint, (wr_mask)(p.x == p.x));\n"
                               "value = v.value, gradient = v.gradient;",
                               kind, ridged),
                   {error, error}}};
    f.note =
        "Times the sum of the octaves' amplitudes times frequencies, 1e-3 at least; compared where no octave's noise "
        "is "
        "within 3e-4 of 0 (turbulence, ridged).";
    return f;
}

/// A function of one number composed with a field.
Function shape(const char* name, const char* summary, const char* source, std::vector<Setting> settings,
               const char* note) {
    std::string numbers;
    for (const Setting& setting : settings) numbers += ", " + setting.name;
    Function f{.name = std::string("shape_") + name, .file = "sources/shape.clh", .summary = summary, .source = source};
    f.parameters = {number("f", "1", "the field"), vector("df_dp", "per metre", "its gradient")};
    f.settings = std::move(settings);
    f.results = {result(number("g", "1", "what becomes of it"), {absolute}),
                 result(vector("dg_dp", "per metre", "the gradient of that"), {relative})};
    f.variants = {{standard,
                   fmt::format("wr_field v = wr_shape_{}((wr_field){{f, df_dp}}{});\n"
                               "g = v.value, dg_dp = v.gradient;",
                               name, numbers),
                   {1e-6, 2e-6}}};
    f.note = note;
    return f;
}

}  // namespace

std::vector<Function> noise_functions() {
    std::vector<Function> all;
    for (const Noise& noise : noises()) {
        all.push_back(row(noise, "", ", exact", "WR_ANALYTIC", noise.gradient, 1e-9));
        all.push_back(
            row(noise, "_forward", " by forward differences over 2^-12 cells", "WR_FORWARD", noise.forward, 1e-4));
        all.push_back(row(noise, "_central", " by central differences over 2^-9 cells to each side", "WR_CENTRAL",
                          noise.central, 1e-4));
    }
    all.push_back(fractal("fractal_sum", "WR_SUM",
                          "Sum of octaves of Perlin's noise and its gradient, no finer than a pixel", "Perlin 1985",
                          1e-3));
    all.push_back(fractal("turbulence", "WR_TURBULENCE",
                          "Sum of magnitudes of octaves of Perlin's noise and its gradient, no finer than a pixel",
                          "Perlin 1985", 1e-3));
    all.push_back(
        fractal("ridged_multifractal", "WR_RIDGED",
                "Ridges where Perlin's noise is 0, rougher where they are high, and the gradient; no finer than a "
                "pixel",
                "Musgrave, in Ebert et al. 2003", 1e-2));
    const auto number_setting = [](const char* name, const char* meaning, double standard_value) {
        return Setting{name, Setting::Kind::number, meaning, {standard_value}};
    };
    all.push_back(shape("remap", "A field brought from [low, high] to [0, 1], unclamped", "Mikkelsen 2020, section 4.6",
                        {number_setting("low", "what becomes 0", -1), number_setting("high", "what becomes 1", 1)},
                        ""));
    all.push_back(shape("ramp", "A field brought from [low, high] to [0, 1], clamped", "Mikkelsen 2020, section 4.6",
                        {number_setting("low", "what becomes 0", -1), number_setting("high", "what becomes 1", 1)},
                        "Gradient 0 outside."));
    all.push_back(shape("wave", "A sine of a field: one wave from low to high, and on", "Mikkelsen 2020, section 4.6",
                        {number_setting("low", "where a wave begins", 0), number_setting("high", "where it ends", 1)},
                        "Over the cosine of the phase; for values of the size of high - low."));
    all.push_back(shape("power", "A power of a field: dents", "Mikkelsen 2020, section 4.6; Upstill 1989",
                        {Setting{"exponent", Setting::Kind::number, "of the power", {2}, 1}}, "0 for f <= 0."));
    all.push_back(shape("smoothstep", "A field eased from 0 at low to 1 at high", "Mikkelsen 2020, section 4.6",
                        {number_setting("low", "what becomes 0", 0), number_setting("high", "what becomes 1", 1)},
                        "Gradient 0 outside."));
    all.push_back(shape("bias", "A field in [0, 1] bent so that 1/2 becomes the bias", "Schlick 1994",
                        {Setting{"bias", Setting::Kind::number, "what 1/2 becomes", {0.25}, 1e-6, 1 - 1e-6}},
                        "Clamped; gradient 0 at 0, at 1 and beyond."));
    return all;
}

}  // namespace wrinkle
