#include <fmt/format.h>

#include <algorithm>

#include "layers/common.h"
#include "plan/noise_text.h"
#include "plan/plan.h"

namespace wrinkle {

namespace {

const NoiseLayer& noise_of(const Layer& layer) { return std::get<NoiseLayer>(layer.bump); }

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<NoiseLayer>(layer);
    scene::read_noise_source(table, bump);
    scene::read_project(table, layer);
    scene::read_weight(table, layer);
    layer.bump = bump;
}

std::string emit(LayerText& at) {
    const std::string text = noise_over(at, noise_of, {.pairs = at.emitter.precision(at.layer) == Precision::exact}) +
                             at.volume("f.gradient");
    if (!at.tells_spread()) return text;
    const std::string strength = at.strength();
    return text + fmt::format(
                      "        lost *= (m * {0}) * (m * {0});\n"
                      "        finer = wr_add(finer, wr_v3(lost, (wr_real)(0), lost));\n",
                      strength);
}

/// The exact variant has points as pairs of floats, which keep their digits far from the origin. There is none where
/// those digits are not known: after a parallax, which moves points by a float, and in a parallel projection.
std::vector<Precision> variants(const Scene& scene, std::size_t index, CameraKind camera) {
    const auto before = scene.layers.begin();
    const bool moved = std::any_of(before, before + static_cast<std::ptrdiff_t>(index), [](const Layer& layer) {
        return std::holds_alternative<ParallaxLayer>(layer.bump);
    });
    if (noise_of(scene.layers[index]).gradient != NoiseGradient::analytic || camera == CameraKind::parallel || moved)
        return {Precision::standard};
    return {Precision::standard, Precision::exact};
}

CostKind cost(const Layer& layer) {
    const NoiseLayer& noise = noise_of(layer);
    const char* const types[] = {"perlin", "perlin1985", "simplex", "worley"};
    const char* const gradients[] = {"", " forward", " central"};
    return {fmt::format("noise {}{}", types[static_cast<int>(noise.type)], gradients[static_cast<int>(noise.gradient)]),
            static_cast<double>(noise.octaves)};
}

}  // namespace

const LayerKind& layers::noise() {
    static constexpr LayerKind row{
        .name = NoiseLayer::kind, .read = read, .emit = emit, .variants = variants, .cost = cost};
    return row;
}

}  // namespace wrinkle
