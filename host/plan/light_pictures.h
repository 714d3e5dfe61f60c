#pragma once

#include <array>
#include <string>
#include <vector>

#include "plan/section.h"

namespace wrinkle {

/// The layers of the frame that show lights of a scene alone, each once; a light's picture has its place among them,
/// from 1 on, as its number.
std::vector<std::string> pictures_of(const Lighting& lighting);
std::size_t picture_number(const std::vector<std::string>& pictures, const Light& light);

/// The most of them that a scene may have.
constexpr std::size_t kMostPictures = 16;

/// Name of the value that holds the radiance of the lights of a picture; of 0: of those without.
const char* lit_name(std::size_t picture);

/// The planes of a picture: those of the layer of this name, or of the only one whose name ends so after a dot. Throws
/// Error, naming layers there are.
std::array<std::string, 3> picture_planes(const Emitter& emitter, const std::string& picture);

}  // namespace wrinkle
