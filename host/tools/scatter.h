#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wrinkle/passes.h"

namespace wrinkle {

/// How `wrinkle scatter` places decals.
struct ScatterOptions {
    std::size_t count = 1000;  ///< at most; fewer where they do not fit
    std::uint64_t seed = 1;
    double spacing = 0;                         ///< least distance of two centres, in `pixels` or metres
    std::array<double, 2> half_size{0.1, 0.2};  ///< from, to; of x and y; in pixels at the surface, or metres
    bool pixels = false;                        ///< whether both are in pixels
    double thickness = 0.5;                     ///< half size along z as a share of that along x
    double depth = 0.1;                         ///< metres for a height of 1, as a share of the half size
    std::uint32_t textures = 1;                 ///< drawn from, each as often
    std::array<std::uint32_t, 2> atlas{1, 1};   ///< columns and rows of each texture; a decal gets one field
    std::vector<ProjectorShape> shapes{ProjectorShape::box};
    ProjectorMode mode = ProjectorMode::add;
    double opacity = 1;
};

/// Places decals on the surface that a G-buffer shows: centres are a Poisson disk sample of its pixels, drawn by the
/// seed, axes stand on the normals, turned at random about them. The same options and planes give the same rows on
/// every machine. Needs depth under a pinhole camera, or position; and normal. Throws Error without them, or when no
/// pixel shows a surface.
std::vector<Projector> scatter_decals(const ScatterOptions& options, const Frame& frame, const HostPlanes& planes);

}  // namespace wrinkle
