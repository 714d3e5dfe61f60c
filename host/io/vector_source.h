#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace wrinkle::io {

/// Which channels hold a vector for every pixel of a frame.
struct VectorSource {
    std::filesystem::path file{};         ///< of the frame's size, its number filled in; empty: the frame's own
    std::string layer{};                  ///< whose X, Y and Z they are, or R, G and B
    std::vector<std::string> channels{};  ///< three, in place of a layer
    bool camera_space = false;            ///< x to the right, y up, z towards the viewer; else world space
};

/// The source's channels among those of its file. Throws Error naming the nearest where there are none.
std::array<std::string, 3> vector_channels(std::span<const std::string> channels, const VectorSource& source);

}  // namespace wrinkle::io
