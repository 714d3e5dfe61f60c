#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kNoiseOctave = 260;  // expected operations
}

std::string emit(LayerText& at, const NoiseLayer& l) {
    double frequency = l.frequency;
    std::size_t first = 0;
    for (int i = 0; i < l.octaves; ++i, frequency *= l.lacunarity) {
        const std::size_t origin =
            at.emitter.origin({.axes = {Vec3{frequency, 0, 0}, Vec3{0, frequency, 0}, Vec3{0, 0, frequency}},
                               .offset = {},
                               .period = 256,
                               .fourth = frequency});
        if (i == 0) first = origin;
    }
    at.section.reads.insert("p");
    if (at.layer.footprint) at.section.reads.insert({"dp_dx", "dp_dy"});
    at.section.operations += kNoiseOctave * l.octaves;
    return at.volume(fmt::format("wr_fractal_gradient(p, origins + {}, {}, {}, {}, active)", 4 * first, literal(l.gain),
                                 l.octaves, at.layer.footprint ? "wr_footprint_size(dp_dx, dp_dy)" : "(real)(0)"));
}

}  // namespace wrinkle
