#pragma once

#include <array>
#include <string>
#include <vector>

#include "plan/section.h"

namespace wrinkle {

/// Names of the frame's layers that show one light, or a few, of the scene alone, or a lobe of them, each name once.
std::vector<std::string> pictures_of(const Lighting& lighting);

/// The numbers of the pictures that show what of a light is diffuse, and what is specular: their places among those of
/// the scene, from 1 on; 0: none does, and it is in the rest of the picture. With `specular_apart` what is specular of
/// that has the number after the last.
struct LightPictures {
    std::size_t diffuse = 0, specular = 0;
};
/// `none`: in place of 0.
LightPictures picture_numbers(const std::vector<std::string>& pictures, const Light& light, bool specular_apart,
                              std::size_t none = 0);

/// The most lights whose shadows are read each apart.
constexpr std::size_t kMostApart = 3;

/// The lights whose shadows are read each apart, by their places among the scene's: those without a picture of what is
/// diffuse, if they are two or three, as then the picture's colours tell which of them reach a pixel. Their numbers
/// follow those of pictures, and that of what is specular. Empty: all have one number, 0.
std::vector<std::size_t> lights_read_apart(const Lighting& lighting, bool specular_apart);

/// The most of them that a scene may have.
constexpr std::size_t kMostPictures = 16;

/// Name of the value that holds the radiance that a picture shows; of 0: that which none does.
const char* lit_name(std::size_t picture);

/// Name of the value that holds what a lit one would be without bumps.
inline std::string old_name(const std::string& lit) { return "old_" + lit; }

/// The planes of the frame's layer called `picture`; if there is none, of the only layer whose name ends in a dot and
/// that name. Throws Error, naming the light that wants it and the layers to choose from.
std::array<std::string, 3> picture_planes(const Emitter& emitter, const std::string& picture);

}  // namespace wrinkle
