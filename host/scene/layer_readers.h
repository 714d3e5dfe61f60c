#pragma once

#include "scene/readers.h"

/// What the readers of the layer kinds share.
namespace wrinkle::scene {

/// footprint, mask
void read_place(Table& table, Layer& layer);
/// scale, blend, footprint, mask
void read_weight(Table& table, Layer& layer);
/// The same, for kinds without levels of detail: footprint is that of the mask's texture, and refused without one.
void read_weight_without_levels(Table& table, Layer& layer);
/// project: for kinds that are gradients in space
void read_project(Table& table, Layer& layer);
/// texture
void read_texture_file(Table& table, TextureUse& texture);
/// y
void read_green(Table& table, TextureUse& texture);
/// upscale
void read_upscale(Table& table, TextureUse& texture);
/// texture, content, y, upscale: for kinds whose texture holds either content
void read_any_texture(Table& table, TextureUse& texture);
/// encoding, slopes
void read_slope_encoding(Table& table, TextureUse& texture);
/// What makes up a noise: all but scale, blend, footprint, mask and project.
void read_noise_source(Table& table, NoiseLayer& bump);
/// wrap, uv
void read_mapped(Table& table, TextureUse& texture, UvMapping& mapping);

/// One function a kind.
void read_normal_map(Table& table, Layer& layer);
void read_height_map(Table& table, Layer& layer);
void read_height_channel(Table& table, Layer& layer);
void read_object_normal(Table& table, Layer& layer);
void read_derivative_map(Table& table, Layer& layer);
void read_triplanar(Table& table, Layer& layer);
void read_noise(Table& table, Layer& layer);
void read_decal(Table& table, Layer& layer);
void read_decals(Table& table, Layer& layer);
void read_volume(Table& table, Layer& layer);
void read_parallax(Table& table, Layer& layer);

}  // namespace wrinkle::scene
