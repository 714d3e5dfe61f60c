#pragma once

#include <string>

/// Layers of scene files. Each is right, and a test appends `rest` to it.
namespace wrinkle {

inline std::string layer(const std::string& rest) { return "[[layer]]\n" + rest; }
inline std::string noise(const std::string& rest) { return layer("kind = \"noise\"\n" + rest); }
inline std::string decal(const std::string& rest) {
    return layer("kind = \"decal\"\ntexture = \"textures/wall.png\"\ncenter = [0, 0, 0]\n" + rest);
}
inline std::string height_map(const std::string& rest) {
    return layer("kind = \"height_map\"\ntexture = \"textures/wall.png\"\n" + rest);
}

inline std::string parallax(const std::string& rest) {
    return layer("kind = \"parallax\"\ntexture = \"textures/wall.png\"\n" + rest);
}

}  // namespace wrinkle
