#pragma once

#include <span>
#include <string>
#include <vector>

#include "wrinkle/lighting.h"

namespace wrinkle {

/// A point of a surface as a picture shows it.
struct SeenSurface {
    Vec3 normal;    ///< unit, world
    Vec3 radiance;  ///< over the albedo: of a white surface
};

/// Lights that explain what surfaces show, and how well they do.
struct LightFit {
    std::vector<Light> lights;  ///< a sky of two colours and a ground, then suns, the strongest first
    /// Of each sun: how far its direction can turn, in degrees, before it explains the picture worse than by noise.
    std::vector<double> loose_degrees;
    std::vector<double> shadowed;  ///< of each sun: share of the surfaces that face it and that it does not reach
    double median = 0, p90 = 0;    ///< of what the lights leave unexplained, as a share of the median radiance
    std::size_t surfaces = 0;
};

/// Fits a sky and up to three suns: what a surface shows is linear in the sky's colours and the suns' irradiances
/// [Ramamoorthi and Hanrahan 2001], given the directions, which are tried on a grid and refined. Robust: every surface
/// is in the light of a sun or in its shadow, whichever explains it better, and surfaces that no light explains
/// (highlights, light from other surfaces) count the less the further off they are (iteratively reweighted least
/// squares). Throws Error where surfaces are too few or face too much the same way.
LightFit fit_lights(std::span<const SeenSurface> surfaces);

}  // namespace wrinkle
