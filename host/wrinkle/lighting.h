#pragma once

#include <vector>

#include "wrinkle/camera.h"

/// Lights of a scene, and what they do to its picture.
///
///     scene.lighting.relight = wrinkle::Relight::lit;
///     scene.lighting.lights = {{.kind = wrinkle::LightKind::sun, .direction = {0.6, 0, -0.8}}};
///
/// Threads: values, used as any other: read by several at once, or changed by one.
namespace [[gnu::visibility("default")]] wrinkle {

enum class LightKind { sun, point, spot };

struct Light {
    LightKind kind = LightKind::sun;
    Vec3 color{1, 1, 1};  ///< sun: irradiance at normal incidence; point, spot: radiant intensity (times intensity)
    double intensity = 1;
    Vec3 position{};                              ///< world; point, spot
    Vec3 direction{0, 0, -1};                     ///< the way the light travels; sun, spot
    double inner_angle = 0.4, outer_angle = 0.6;  ///< radians from the axis; spot
};

enum class Relight { off, lit, ratio };

struct Lighting {
    Relight relight = Relight::off;
    Vec3 ambient{0, 0, 0};
    Vec3 albedo{0.5, 0.5, 0.5};  ///< where the G-buffer has none
    double roughness = 0.5;      ///< where the G-buffer has none
    double f0 = 0.04;            ///< specular reflectance at normal incidence
    double max_ratio = 4;        ///< bound of lit(new)/lit(old), and 1/bound below
    double exposure = 0;         ///< stops, of the PNG only
    std::vector<Light> lights;
};

}  // namespace wrinkle
