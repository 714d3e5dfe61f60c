#pragma once

#include <variant>

#include "scene/readers.h"

/// What the readers of the layer kinds share.
namespace wrinkle::scene {

/// The bump that a reader fills in: the one that the layer holds, or a new one of this kind.
template <class Bump>
Bump held(const Layer& layer) {
    const Bump* bump = std::get_if<Bump>(&layer.bump);
    return bump ? *bump : Bump{};
}

/// footprint, mask
void read_place(Table& table, Layer& layer);
/// scale, blend, footprint, mask
void read_weight(Table& table, Layer& layer);
/// The same, for kinds without levels of detail: footprint is that of the mask's texture, and refused without one.
void read_weight_without_levels(Table& table, Layer& layer);
/// project: for kinds that are gradients in space
void read_project(Table& table, Layer& layer);
/// layer, channels, zero: which parts of a file are used
void read_texture_choice(Table& table, TextureUse& texture);
/// texture, as a file name or as a table of a file and its choice. Returns whether it is there.
bool read_texture_name(Table& table, TextureUse& texture);
/// texture
void read_texture_file(Table& table, TextureUse& texture);
/// The same, for kinds whose texture holds one content only.
void read_texture_of(Table& table, TextureUse& texture, Content content);
/// Checks all members of a texture of a scene in memory, also those for which files of this kind have no key. All of
/// them are compiled in.
void visit_texture(Table& table, TextureUse& texture);
/// y
void read_green(Table& table, TextureUse& texture);
/// upscale
void read_upscale(Table& table, TextureUse& texture);
/// upscale, with "taps" among the choices
void read_any_upscale(Table& table, TextureUse& texture);
/// Complains of a texture of <UDIM> tiles, where there are no texture coordinates that tell them apart.
void refuse_tiles(Table& table, const char* key, const TextureUse& texture);
/// Tiles are loaded as one image of so many columns and rows of unit squares, so the mapping's scale and offset are
/// divided by these here. Scenes made in code give coordinates of the whole image themselves.
void span_tiles(Table& table, const TextureUse& texture, UvMapping& mapping);
/// texture, content, y, upscale: for kinds whose texture holds either content
void read_any_texture(Table& table, TextureUse& texture);
/// encoding, slopes
void read_slope_encoding(Table& table, TextureUse& texture);
/// What makes up a noise: all but scale, blend, footprint, mask and project (scene/read_noise.cpp).
void read_noise_source(Table& table, NoiseLayer& bump);
/// planes of a triplanar projection, and what those without a source of their own show (scene/read_planes.cpp).
void read_planes(Table& table, TriplanarLayer& bump);
/// wrap, uv
void read_mapped(Table& table, TextureUse& texture, UvMapping& mapping);

}  // namespace wrinkle::scene
