#pragma once

#include <string>

#include "scene/toml.h"

namespace wrinkle::scene {

/// Replaces values of a scene, or adds them, as `setting` says: "KEY = VALUE" in TOML, the key with the tables it is in
/// ("lighting.exposure", "layer.cobbles.uv.scale"). A layer is told by its name or its number, a light by its number,
/// both from 1. What is no TOML value is taken as a text, as shells take the quotes off. Throws Error for a table that
/// is not there to be chosen from; what the value means is found out by who reads the scene.
void set_value(toml::table& scene, const std::string& setting);

}  // namespace wrinkle::scene
