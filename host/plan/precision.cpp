#include "plan/precision.h"

#include <algorithm>

namespace wrinkle {

using enum Precision;

namespace {

/// A parallax moves points by a float, so nothing is left of the digits that pairs keep.
bool moved(const Scene& scene, std::size_t index) {
    const auto layers = scene.layers.begin();
    return std::any_of(layers, layers + static_cast<std::ptrdiff_t>(index),
                       [](const Layer& layer) { return std::holds_alternative<ParallaxLayer>(layer.bump); });
}

}  // namespace

std::vector<Precision> layer_precisions(const Scene& scene, std::size_t index, CameraKind camera) {
    const auto& bump = scene.layers[index].bump;
    if (std::holds_alternative<NormalMapLayer>(bump) || std::holds_alternative<HeightMapLayer>(bump) ||
        std::holds_alternative<HeightChannelLayer>(bump) || std::holds_alternative<DerivativeMapLayer>(bump))
        return {standard, exact};
    const auto* noise = std::get_if<NoiseLayer>(&bump);
    if (noise == nullptr || noise->gradient != NoiseGradient::analytic || camera == CameraKind::parallel ||
        moved(scene, index))
        return {standard};
    return {standard, exact};
}

std::vector<Precision> geometry_precisions() { return {standard, exact}; }

Precision served(const std::vector<Precision>& ladder, Precision wanted) {
    const auto found = std::ranges::find_if(ladder, [&](Precision precision) { return precision >= wanted; });
    return found == ladder.end() ? ladder.back() : *found;
}

}  // namespace wrinkle
