#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "run/plane_buffers.h"
#include "wrinkle/passes.h"

namespace wrinkle::bench {

/// A G-buffer in memory, and a scene that fits it.
struct BenchFrame {
    Frame frame;
    std::map<std::string, std::vector<float>> planes;

    std::size_t pixels() const { return std::size_t{frame.size.width} * frame.size.height; }
    std::map<std::string, std::span<const float>> spans() const;
};

/// The scene's G-buffer resampled to `size`: bilinear where four neighbours belong to one object without a seam of the
/// texture coordinates, else the nearest; depth as its reciprocal, which is linear on planes.
BenchFrame resampled_frame(const Scene& scene, Size size);

/// The scene as all contenders take it: no lighting, Cryptomatte names as hashes.
Scene without_lighting(Scene scene, const Frame& frame);

/// Input planes on the device.
PlaneBuffers upload(const Device& device, const BenchFrame& frame, const std::vector<std::string>& names);

}  // namespace wrinkle::bench
