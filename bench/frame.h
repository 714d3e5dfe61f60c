#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "run/plane_buffers.h"
#include "wrinkle/passes.h"

namespace wrinkle::bench {

/// A G-buffer in memory, with its description.
struct BenchFrame {
    Frame frame;
    std::map<std::string, std::vector<float>> planes;

    std::size_t pixels() const { return std::size_t{frame.size.width} * frame.size.height; }
    std::map<std::string, std::span<const float>> spans() const;
};

/// A scene's G-buffer at any size. Bilinear where the four pixels around belong to one object and no seam of the
/// texture coordinates lies between them, else the nearest pixel. Of depth the reciprocal is blended, which is linear
/// on planes.
class Resampler {
public:
    explicit Resampler(const Scene& scene);

    /// The whole frame, every plane.
    BenchFrame frame(Size size) const;
    /// Rows [first, first + count) of a frame of `size`.
    std::map<std::string, std::vector<float>> rows(Size size, std::uint32_t first, std::uint32_t count,
                                                   const std::vector<std::string>& names) const;
    /// The frame as evaluate() takes it, of the G-buffer's own size.
    const Frame& description() const { return frame_; }

private:
    bool smooth(const std::array<std::size_t, 4>& pixels) const;  ///< four pixels may be blended

    Frame frame_;
    Size size_;
    std::map<std::string, std::vector<float>> planes_;
};

/// The scene in a form that all contenders take: without lighting, with hashes for Cryptomatte names, and with
/// one point a pixel.
Scene without_lighting(Scene scene, const Frame& frame);

/// Input planes on the device.
PlaneBuffers upload(const Device& device, const BenchFrame& frame, const std::vector<std::string>& names);

}  // namespace wrinkle::bench
