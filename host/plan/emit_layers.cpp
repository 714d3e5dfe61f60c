#include <fmt/format.h>

#include <cmath>
#include <span>

#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

std::size_t layers_together(const std::vector<Layer>& layers, std::size_t first) {
    std::size_t count = 1;
    if (!std::holds_alternative<DecalLayer>(layers[first].bump)) return count;
    while (first + count < layers.size() && std::holds_alternative<DecalLayer>(layers[first + count].bump) &&
           same_loop(layers[first], layers[first + count]))
        ++count;
    return count;
}

Section emit_layers(Emitter& emitter, const std::vector<const Layer*>& layers) {
    const Layer& layer = *layers.front();
    Section section;
    section.title = fmt::format("{} \"{}\"", layer.kind(), layer.name);
    if (layers.size() > 1) section.title += fmt::format(" and {} more", layers.size() - 1);
    const std::string who = layer_label(layer);
    for (const Layer* each : layers)
        if (!std::isfinite(each->scale))
            throw Error(fmt::format("{}: scale is {}; it must be finite", layer_label(*each), each->scale));
    const std::size_t known_textures = emitter.plan.textures.size();
    const std::string mask = emit_mask(emitter, layer, section);
    LayerText text{emitter, layer, who, section};
    const std::string bump = std::visit(
        [&](const auto& l) -> std::string {
            if constexpr (requires { emit(text, l); })
                return emit(text, l);
            else if constexpr (std::is_same_v<std::decay_t<decltype(l)>, DecalLayer>)
                return emit_decals(text, layers);
            else
                return {};
        },
        layer.bump);
    for (PlannedTexture& texture : std::span(emitter.plan.textures).subspan(known_textures)) texture.layer = who;
    std::string condition = "wr_any(active)";
    if (emitter.options.switches)
        condition = fmt::format("origins[{}] != 0 && {}", 4 * emitter.origin({.fourth = layer.scale}) + 3, condition);
    section.body = mask + (emitter.options.skip ? "" : "        active = (wr_mask)(-1);\n") +
                   fmt::format("        if ({}) {{\n{}        }}\n", condition, bump);
    return section;
}

}  // namespace wrinkle
