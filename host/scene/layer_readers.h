#pragma once

#include <variant>

#include "scene/readers.h"

/// What the readers of the layer kinds share.
namespace wrinkle::scene {

/// What a reader goes on from: the bump that the layer holds, or a new one of this kind.
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
/// layer, channels, zero: of a file's parts, which are wanted
void read_texture_choice(Table& table, TextureUse& texture);
/// The value of texture: a file, or a table of one with its choice. Whether there is one.
bool read_texture_name(Table& table, TextureUse& texture);
/// texture
void read_texture_file(Table& table, TextureUse& texture);
/// The same, for kinds whose texture holds one content only.
void read_texture_of(Table& table, TextureUse& texture, Content content);
/// What a texture in memory holds, whether files of the kind can say so or not; all of it is compiled in.
void visit_texture(Table& table, TextureUse& texture);
/// y
void read_green(Table& table, TextureUse& texture);
/// upscale
void read_upscale(Table& table, TextureUse& texture);
/// Complains of a texture of <UDIM> tiles, where there are no texture coordinates that tell them apart.
void refuse_tiles(Table& table, const char* key, const TextureUse& texture);
/// A texture of tiles becomes one image of all of them, so its coordinates shrink by as much as that is larger. A scene
/// that was made in code holds such coordinates already.
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
