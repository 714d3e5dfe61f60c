#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include "wrinkle/lighting.h"

namespace wrinkle::scene {

/// Takes what is wrong with a light: the keys of a [[light]] that it is about, and the rest of the sentence.
using LightFault = std::function<void(std::initializer_list<const char*> keys, const std::string& text)>;

/// Tells what single values of a light cannot show: what its kind asks of its radius, its size and its directions. One
/// list for scenes and for tables of lights.
void check_light(const Light& light, const LightFault& fault);

}  // namespace wrinkle::scene
