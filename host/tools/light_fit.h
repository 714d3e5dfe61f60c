#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/lighting.h"

namespace wrinkle {

/// A point of a surface as a picture shows it.
struct SeenSurface {
    Vec3 normal;                  ///< unit, world
    Vec3 radiance;                ///< over the albedo: of a white surface
    std::optional<Vec3> place{};  ///< in the world
};

/// Lights that explain what surfaces show, and how well they do.
struct LightFit {
    std::vector<Light> lights;  ///< a sky of two colours and a ground, then suns and points, the strongest first
    /// Of each sun and point: how far its direction can turn, in degrees, or the point move, in metres, before it
    /// explains the picture worse than by noise.
    std::vector<double> loose;
    std::vector<double> shadowed;  ///< of each of them: share of the surfaces that face it and that it does not reach
    double median = 0, p90 = 0;    ///< of what the lights leave unexplained, as a share of the median radiance
    std::size_t surfaces = 0;
};

/// Fits a sky and up to three suns or points: what a surface shows is linear in the sky's colours and the lamps'
/// [Ramamoorthi and Hanrahan 2001], given the directions and places, which are tried on grids and refined: nonlinear
/// least squares in what is not linear. Points are tried where all surfaces have places, by how their light falls off;
/// which kind a lamp is, what is left unexplained says. Robust: every surface is in the light of a lamp or in its
/// shadow, whichever explains it better, and surfaces that no light explains (highlights, light from other surfaces)
/// count the less the further off they are (iteratively reweighted least squares). Throws Error where surfaces are too
/// few or face too much the same way.
LightFit fit_lights(std::span<const SeenSurface> surfaces);

/// By what suns, points and spheres have to be multiplied to be as strong as what surfaces show of them.
struct LightScale {
    double scale = 0;
    double share = 0;  ///< of the surfaces' light, that of these lights
    /// How far one light's own factor is from `scale`, by which it is divided or multiplied: 1 where all agree.
    double apart = 1;
    double median = 0;  ///< of what they and the sky leave unexplained, as a share of the median radiance
    Light sky;          ///< in the picture's units
};

/// Fits a sky, and one factor for up to three suns, points and spheres whose places are known, as fit_lights() does.
/// Throws Error where surfaces are too few or face too much the same way, or have no places and one of the lights has.
LightScale fit_scale(std::span<const SeenSurface> surfaces, std::span<const Light> lamps);

}  // namespace wrinkle
