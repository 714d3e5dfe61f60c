#pragma once

#include <span>
#include <string>
#include <vector>

namespace wrinkle::io {

/// Layers of colours that renderers name after a light or a group of lights: Blender's Combined_GROUP, Arnold's
/// RGBA_GROUP, diffuse_GROUP and specular_GROUP, V-Ray's LightSelect_NAME, Karma's C_TAG, RenderMan's beauty_GROUP.
std::vector<std::string> light_pictures(std::span<const std::string> channels);

}  // namespace wrinkle::io
