#pragma once

#include <array>
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

enum class LightKind { sun, point, spot, sky, sphere, disc, rectangle };

/// Irradiance / pi on a surface by its unit normal: the sum of these times 1, x, y, z, xy, yz, zx, x^2 - y^2, 3 z^2
/// - 1.
using SkyHarmonics = std::array<Vec3, 9>;

struct Light {
    LightKind kind = LightKind::sun;
    /// Times intensity. sun: irradiance at normal incidence; others: radiant intensity, of discs and rectangles along
    /// their direction, which is their radiance times their area (of spheres pi radius^2)
    Vec3 color{1, 1, 1};
    double intensity = 1;
    Vec3 position{};                              ///< world; of the middle; all but sun, sky
    Vec3 direction{0, 0, -1};                     ///< the way the light travels; sun, spot, disc, rectangle
    double inner_angle = 0.4, outer_angle = 0.6;  ///< radians from the axis; spot
    /// Metres at which the light has faded away, by (1 - (distance / range)^4)^2; nothing: it reaches everywhere.
    /// All but sun, sky
    std::optional<double> range{};
    /// Layers of the frame that show this light's share of the picture alone: all of it, or what is diffuse and what is
    /// specular of it apart; empty: none does. All but sky
    std::string picture{}, diffuse{}, specular{};
    Vec3 up{0, 0, 1};          ///< sky: where the zenith is; rectangle: the way its height goes
    Vec3 zenith{}, horizon{};  ///< sky: radiance, between them linear in the sine of the elevation (times intensity)
    Vec3 ground{};             ///< sky: radiance below the horizon
    double angle = 0;          ///< sun: radians that its disc is wide; 0: a point in the sky
    double radius = 0;         ///< metres; sphere (0: a point), disc
    std::array<double, 2> size{};     ///< metres, width and height; rectangle
    std::filesystem::path texture{};  ///< sky: the picture that harmonics are from; empty for those made in code
    /// sky: whether surfaces mirror it; of a sky with harmonics only where `texture` names the picture
    bool highlights = false;
    double rotation = 0;  ///< sky: radians by which the picture turns around up, counter-clockwise seen from above
    /// sky: what a picture of all directions makes of it, in place of zenith, horizon and ground; see load_sky
    std::optional<SkyHarmonics> harmonics{};
    std::string location{};  ///< "scene.toml:12" for messages; empty for lights made in code
};

/// What an object of metal mirrors, by the direction, as its own picture shows it: kVertices x kVertices radiances on
/// an octahedron folded out to a square, z in its middle, x to the right, y up, row by row from the bottom.
struct MetalPicture {
    static constexpr std::size_t kVertices = 33;
    /// Whose, in the plane `object`, where the frame has one; else that of all metal.
    double object = 0;
    std::vector<Vec3> seen = std::vector<Vec3>(kVertices * kVertices);
};

enum class Relight { off, lit, ratio };

/// How a picture that is relit tells where a light reaches that has no picture of its own.
enum class Shadows {
    automatic,  ///< read by `wrinkle run` where the picture tells how strong the lights are in its units; else ignored
    ignored,    ///< it does not: all light of the picture is shared out as if no light was shadowed, in any unit
    read        ///< off the picture, for lights in its units: what it shows beside the sky's, over what they would give
};

struct Lighting {
    Relight relight = Relight::off;
    Shadows shadows = Shadows::automatic;  ///< Relight::ratio
    Vec3 ambient{0, 0, 0};                 ///< radiance from all around, beside that of skies
    Vec3 albedo{0.5, 0.5, 0.5};            ///< where the G-buffer has none
    double roughness = 0.5;                ///< where the G-buffer has none
    double f0 = 0.04;                      ///< specular reflectance at normal incidence
    double max_ratio = 4;                  ///< bound of lit(new)/lit(old), and 1/bound below
    double exposure = 0;                   ///< stops, of the PNG only
    std::vector<Light> lights;
    /// Points, spots, spheres, discs and rectangles beside these, as many as you like: where they have ranges, the cost
    /// follows how many reach a pixel. They have no pictures of their own.
    std::shared_ptr<const std::vector<Light>> table{};
    std::filesystem::path table_file{};  ///< that the table, or more lights, are from; empty for those made in code
    /// Relight::ratio: metal that is relit by what its own picture shows. `wrinkle run` makes them of each frame;
    /// metal without one stays as it is.
    std::shared_ptr<const std::vector<MetalPicture>> metals{};
    std::optional<Mask> leave{};  ///< where the picture stays as it is; a mask without a texture
};

/// Projects a picture of all directions (latitude and longitude, linear; the top row is up, z; its middle column x,
/// what is right of that -y, as in Blender) to spherical harmonics of order 2, which hold the irradiance of usual skies
/// to 3% [Ramamoorthi and Hanrahan 2001]. Throws Error where the file is no such picture.
SkyHarmonics load_sky(const std::filesystem::path& file);

/// Reads a table of lights: CSV, a row of column names, then a row a light; TOML (.toml), a [[light]] a row; or .npy,
/// records with fields named as the columns of CSV are; data/scenes/README.md lists them. Throws Error with the line
/// (.npy: the row) and column of each mistake, the first 20 of them.
std::vector<Light> load_lights(const std::filesystem::path& file);

}  // namespace wrinkle
