#include <fmt/format.h>

#include <span>

#include "plan/layer_text.h"
#include "plan/own_gradient.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr std::size_t kMostTogether = 32;  // a bit of an unsigned number for each

}  // namespace

std::size_t layers_together(LayerKinds kinds, const std::vector<Layer>& layers, std::size_t first) {
    const LayerKind& kind = kind_of(kinds, layers[first]);
    std::size_t count = 1;
    while (kind.joins && count < kMostTogether && first + count < layers.size() &&
           &kind_of(kinds, layers[first + count]) == &kind && kind.joins(layers[first], layers[first + count]))
        ++count;
    return count;
}

Section emit_layers(Emitter& emitter, const std::vector<const Layer*>& layers, bool space) {
    const Layer& layer = *layers.front();
    const LayerKind& kind = emitter.kind(layer);
    Section section;
    section.kind = kind.name;
    section.title = fmt::format("{} \"{}\"", kind.name, layer.name);
    if (layers.size() > 1) section.title += fmt::format(" and {} more", layers.size() - 1);
    const std::string who = layer_label(layer);
    const std::size_t known_textures = emitter.plan.textures.size();
    section.area = varies_over_area(emitter, layer);
    const MaskText mask = emit_mask_parts(emitter, layer, section);
    LayerText text{emitter, layers, layer, who, section, space};
    const std::string bump = kind.emit ? kind.emit(text) : "";
    for (PlannedTexture& texture : std::span(emitter.plan.textures).subspan(known_textures)) texture.layer = who;
    const std::size_t index = emitter.index_of(layer);
    std::string condition = "wr_any(active)";
    if (emitter.options.switches) condition = fmt::format("{} != 0 && {}", text.strength(), condition);
    // In every layer's own blocks, so that nothing of it is kept from layer to layer.
    const auto share = [&](const char* tap, const char* shift) {
        return section.area && emitter.scene.filter.taps > 1 ? share_text(section.reads.contains("uv"), tap, shift)
                                                             : "";
    };
    const std::string here = share("tap", "shift"),
                      prepared = text.prepared.empty()
                                     ? ""
                                     : fmt::format("        if (WR_LANES == 1) {{\n{}        }}\n", text.prepared);
    section.body = (layer.mask.texture ? here : "") + mask.rest +
                   (text.active_at_any_point ? fmt::format("        active = wanted_{};\n", index) : "") +
                   (emitter.options.skip ? "" : "        active = (wr_mask)(-1);\n") +
                   fmt::format("        if ({}) {{\n{}{}{}        }}\n", condition, here, prepared, bump);
    if (writes_own_gradient(emitter, layer)) add_own_gradient(section, index);
    if (!section.area) {
        section.body = mask.planes + section.body;
        return section;
    }
    // What planes say of the mask holds for the whole pixel, so it is evaluated once, before the points of its area.
    section.wanted = fmt::format("wanted_{}", index);
    section.masks = fmt::format(
        "        wr_real mask_{0};\n        wr_mask wanted_{0} = valid;\n{1}        {{\n{2}        mask_{0} = m;\n",
        index, text.declared, mask.planes);
    if (!mask.everywhere && emitter.options.skip)
        section.masks +=
            fmt::format("        wanted_{0} = wanted_{0} & ({1} != 0);\n", index, layer.mask.invert ? "(1 - m)" : "m");
    section.masks += "        }\n";
    if (!text.before.empty())
        section.before = fmt::format("        if (wr_any(wanted_{})) {{\n{}        }}\n", index, text.before);
    if (!text.prepared.empty())
        section.before += fmt::format(
            "        if (WR_LANES > 1 && wr_any(wanted_{0})) {{\n        wr_real m = mask_{0};\n{1}{2}        }}\n",
            index, share("0", "(wr_real)(0)"), text.prepared);
    section.body = fmt::format("        wr_real m = mask_{};\n", index) + section.body;
    return section;
}

}  // namespace wrinkle
