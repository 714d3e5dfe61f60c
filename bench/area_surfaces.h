#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "frame.h"
#include "wrinkle/scene.h"

namespace wrinkle::bench {

/// What a layer lies on, and the camera that sees it: frames are exact, as many points of a pixel as wanted.
class AreaSurface {
public:
    /// The first surface along a ray.
    struct Hit {
        double depth;  ///< in lengths of the ray
        Vec3 normal;   ///< unit
        double u, v;   ///< metres / kGroundRepeat
    };
    using FirstHit = std::optional<Hit> (*)(const Vec3& eye, const Vec3& ray);

    AreaSurface(std::string name, Size size, const Camera& camera, FirstHit first_hit)
        : name(std::move(name)), size(size), camera_(camera), first_hit_(first_hit) {}

    /// The frame with `factor` x `factor` pixels for each.
    BenchFrame frame(std::uint32_t factor) const;
    /// `points` x `points` points of each pixel of column x, as a frame of their own: those of the top pixel first.
    BenchFrame column(std::uint32_t x, std::uint32_t points) const;

    std::string name;
    Size size;

    /// Where a decal and a volume lie on it: metres, and as a share of its side how far before y = 0 the volume begins.
    Vec3 decal_center{}, decal_x{1, 0, 0}, decal_y{0, 1, 0};
    double volume_side = 8, volume_middle = 0.75;

private:
    BenchFrame window(Size whole, std::uint32_t left, Size window) const;

    Camera camera_;
    FirstHit first_hit_;
};

/// A ground to the horizon seen from 1.6 m up, a wall along the view, and a ball of 1 m.
std::vector<AreaSurface> area_surfaces();

}  // namespace wrinkle::bench
