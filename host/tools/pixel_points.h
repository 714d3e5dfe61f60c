#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "wrinkle/passes.h"

/// The area of a pixel as a frame of its own.
namespace wrinkle {

constexpr std::uint32_t kPointsAlong = 32;  ///< of the area, along each of its sides
constexpr std::size_t kPointsOfPixel = std::size_t{kPointsAlong} * kPointsAlong;

/// What a frame's planes show in kPointsAlong x kPointsAlong points of one pixel, if its surface goes on as the plane
/// through its point, across its normal. What is neither a place nor a texture coordinate stays what it is in the
/// pixel.
class PixelPoints {
public:
    using Planes = std::map<std::string, std::span<const float>>;

    /// `planes` are those of the whole frame, and must outlive this. Throws Error unless a pinhole camera sees it.
    PixelPoints(const Frame& frame, const Planes& planes);

    /// Writes the points to `out`, kPointsOfPixel floats a plane. False where there are none to trust: no surface, one
    /// that some rays miss, or texture coordinates that no neighbour on the same surface continues.
    bool write(std::uint32_t x, std::uint32_t y, const std::map<std::string, float*>& out) const;

    /// The camera that sees nothing but the pixel, in kPointsAlong x kPointsAlong pixels.
    Camera camera(std::uint32_t x, std::uint32_t y) const;

    /// Of unit length, towards the viewer; nothing where there is no surface.
    std::optional<Vec3> normal(std::uint32_t x, std::uint32_t y) const;

private:
    /// How places and texture coordinates change together, along two directions on the surface.
    struct Chart {
        std::array<Vec3, 2> along;
        std::array<std::array<double, 2>, 2> uv;
    };

    double value(const std::string& plane, std::uint32_t x, std::uint32_t y) const;
    bool has(const std::string& plane) const { return planes_.contains(plane); }
    Vec3 ray(double x, double y) const;
    std::optional<Vec3> point(std::uint32_t x, std::uint32_t y) const;
    std::optional<Chart> chart(std::uint32_t x, std::uint32_t y) const;

    Frame frame_;
    PinholeRays rays_{};
    const Planes& planes_;
};

}  // namespace wrinkle
