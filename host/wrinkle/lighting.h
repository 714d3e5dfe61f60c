#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/camera.h"
#include "wrinkle/layers.h"

/// Lights of a scene, and what they do to its picture.
///
///     scene.lighting.relight = wrinkle::Relight::lit;
///     scene.lighting.lights = {{.kind = wrinkle::LightKind::sun, .direction = {0.6, 0, -0.8}}};
///
/// Threads: values, used as any other: read by several at once, or changed by one.
namespace [[gnu::visibility("default")]] wrinkle {

enum class LightKind { sun, point, spot, sky };

struct Light {
    LightKind kind = LightKind::sun;
    Vec3 color{1, 1, 1};  ///< sun: irradiance at normal incidence; point, spot: radiant intensity (times intensity)
    double intensity = 1;
    Vec3 position{};                              ///< world; point, spot
    Vec3 direction{0, 0, -1};                     ///< the way the light travels; sun, spot
    double inner_angle = 0.4, outer_angle = 0.6;  ///< radians from the axis; spot
    /// Metres at which the light has faded away, by (1 - (distance / range)^4)^2; nothing: it reaches everywhere.
    /// point, spot
    std::optional<double> range{};
    /// Layers of the frame that show this light's share of the picture alone: all of it, or what is diffuse and what is
    /// specular of it apart; empty: none does. sun, point, spot
    std::string picture{}, diffuse{}, specular{};
    Vec3 up{0, 0, 1};          ///< sky: where the zenith is
    Vec3 zenith{}, horizon{};  ///< sky: radiance, between them linear in the sine of the elevation (times intensity)
    Vec3 ground{};             ///< sky: radiance below the horizon
    std::string location{};    ///< "scene.toml:12" for messages; empty for lights made in code
};

enum class Relight { off, lit, ratio };

/// How a picture that is relit tells where a light reaches that has no picture of its own.
enum class Shadows {
    ignored,  ///< it does not: all light of the picture is shared out as if no light was shadowed, in any unit
    read      ///< off the picture, for lights in its units: what it shows beside the sky's, over what they would give
};

struct Lighting {
    Relight relight = Relight::off;
    Shadows shadows = Shadows::ignored;  ///< Relight::ratio
    Vec3 ambient{0, 0, 0};               ///< radiance from all around, beside that of skies
    Vec3 albedo{0.5, 0.5, 0.5};          ///< where the G-buffer has none
    double roughness = 0.5;              ///< where the G-buffer has none
    double f0 = 0.04;                    ///< specular reflectance at normal incidence
    double max_ratio = 4;                ///< bound of lit(new)/lit(old), and 1/bound below
    double exposure = 0;                 ///< stops, of the PNG only
    std::vector<Light> lights;
    /// Points and spots beside these, as many as you like: where they have ranges, the cost follows how many reach a
    /// pixel. They have no pictures of their own.
    std::shared_ptr<const std::vector<Light>> table{};
    std::filesystem::path table_file{};  ///< that the table, or more lights, are from; empty for those made in code
    std::optional<Mask> leave{};         ///< where the picture stays as it is; a mask without a texture
};

/// Reads a table of lights: CSV, a row of column names, then a row a light; TOML (.toml), a [[light]] a row; or .npy,
/// records with fields named as the columns of CSV are; data/scenes/README.md lists them. Throws Error with the line
/// (.npy: the row) and column of each mistake, the first 20 of them.
std::vector<Light> load_lights(const std::filesystem::path& file);

}  // namespace wrinkle
