#pragma once

#include "layers/rows.h"
#include "plan/layer_text.h"
#include "scene/layer_readers.h"

/// What files of kinds include, and what several rows hold.
namespace wrinkle::layers {

/// The use of kinds whose texture lies by the UV pass; a planar mapping does without it.
inline constexpr const char* uv_role[] = {"uv"};
inline constexpr LayerUse on_uv[] = {{"", uv_role}};

/// Of kinds whose frames and slopes have a compensated variant.
inline std::vector<Precision> standard_and_exact(const Scene&, std::size_t, CameraKind) {
    return {Precision::standard, Precision::exact};
}

/// The row of a kind whose texture lies on texture coordinates and gives slopes.
constexpr LayerKind slopes_on_uv(const char* name, void (*read)(scene::Table& table, Layer& layer),
                                 std::string (*emit)(LayerText& at), std::span<const LayerUse> uses = on_uv) {
    return {.name = name, .read = read, .emit = emit, .uses = uses, .variants = standard_and_exact};
}

}  // namespace wrinkle::layers
