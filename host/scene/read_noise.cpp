#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/layer_readers.h"

namespace wrinkle::scene {
namespace {

void read_type(Table& table, NoiseLayer& bump) {
    table.choose("type", bump.type,
                 {{"perlin", NoiseType::perlin},
                  {"perlin1985", NoiseType::perlin1985},
                  {"simplex", NoiseType::simplex},
                  {"worley", NoiseType::worley}});
    table.choose("feature", bump.feature,
                 {{"f1", CellFeature::f1}, {"f2", CellFeature::f2}, {"f2-f1", CellFeature::f2_f1}});
    table.choose("gradient", bump.gradient,
                 {{"analytic", NoiseGradient::analytic},
                  {"forward", NoiseGradient::forward},
                  {"central", NoiseGradient::central}});
    table.only_with("feature", bump.type == NoiseType::worley, "type", "worley");
}

void read_fractal(Table& table, NoiseLayer& bump) {
    // The bounds keep the frequency and the amplitude of a 16th octave within float32.
    table.read("frequency", bump.frequency, {.low = 0, .high = 1e9, .low_is_allowed = false});
    table.read("octaves", bump.octaves, 1, 16);
    table.compiled_in("octaves", bump.octaves);
    table.read("lacunarity", bump.lacunarity, {.low = 0, .high = 16, .low_is_allowed = false});
    table.read("gain", bump.gain, {.low = 0, .high = 16});
    table.choose("fractal", bump.fractal,
                 {{"sum", FractalKind::sum}, {"turbulence", FractalKind::turbulence}, {"ridged", FractalKind::ridged}});
    if (bump.fractal != FractalKind::sum && bump.type == NoiseType::worley)
        table.complain("fractal", "takes the magnitude of the noise, and worley is never negative; use \"sum\"");
    table.read("offset", bump.offset, {.low = 0, .high = 16});
    table.read("feedback", bump.feedback, {.low = 0, .high = 1000});
    for (const char* key : {"offset", "feedback"})
        table.only_with(key, bump.fractal == FractalKind::ridged, "fractal", "ridged");
}

void read_simplex(Table& table, NoiseLayer& bump) {
    constexpr double kMostCells = 1 << 20;  // what the kernel's lattice can tell apart
    table.read_degrees("rotation", bump.rotation);
    if (table.read("period", bump.period, {.low = 0, .high = kMostCells}) && bump.period != Vec3{}) {
        const double last = std::pow(bump.lacunarity, bump.octaves - 1);
        if (std::ranges::any_of(bump.period, [](double cells) { return cells != std::floor(cells); }))
            table.complain("period",
                           "must be whole numbers of lattice cells, one an axis; 0 for an axis that does not repeat");
        else if (bump.octaves > 1 && (bump.lacunarity < 1 || bump.lacunarity != std::floor(bump.lacunarity)))
            table.complain("period",
                           fmt::format("of several octaves needs a whole lacunarity; it is {}", bump.lacunarity));
        else if (std::ranges::max(bump.period) * last > kMostCells)
            table.complain("period", fmt::format("is {} cells for the last octave; at most {} can be told apart",
                                                 std::ranges::max(bump.period) * last, kMostCells));
    }
    const bool simplex = bump.type == NoiseType::simplex;
    for (const char* key : {"rotation", "period"}) table.only_with(key, simplex, "type", "simplex");
    if (simplex) table.compiled_in("rotation", bump.rotation != 0);
    for (const double cells : bump.period)
        if (simplex) table.compiled_in("period", cells != 0);
}

bool read_interval(Table& table, const char* key, std::optional<std::array<double, 2>>& out) {
    if (!table.read(key, out)) return false;
    if (!(out->front() < out->back())) table.complain(key, "must be [low, high], the smaller number first");
    return true;
}

void read_shape(Table& table, NoiseShape& shape) {
    read_interval(table, "remap", shape.remap);
    int chosen = 0;
    if (table.read("power", shape.power, Range{.low = 1, .high = 100})) ++chosen;
    if (read_interval(table, "smoothstep", shape.smoothstep)) ++chosen;
    if (table.read("bias", shape.bias, Range{.low = 0, .high = 1, .low_is_allowed = false, .high_is_allowed = false}))
        ++chosen;
    if (chosen > 1)
        table.complain_here(
            fmt::format("{} has more than one of the keys power, smoothstep, bias; choose one", table.where()));
    table.finish();
}

}  // namespace

void read_noise_source(Table& table, NoiseLayer& bump) {
    read_type(table, bump);
    read_fractal(table, bump);
    read_simplex(table, bump);
    if (auto shape = table.table("shape", "shape of " + table.where())) read_shape(*shape, bump.shape);
}

}  // namespace wrinkle::scene
