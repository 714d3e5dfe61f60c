#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/textures.h"

/// Decals: one, or a table of them.
///
///     const std::vector<wrinkle::Projector> rows(3, {.center = {0, 0, 1}, .half_size = {0.2, 0.2, 0.5}});
///     wrinkle::save_decals("three.csv", rows);
///     wrinkle::DecalsLayer seals;
///     seals.textures = {{.file = "seal.png", .wrap = wrinkle::Wrap::clamp}};
///     seals.rows = std::make_shared<const std::vector<wrinkle::Projector>>(wrinkle::load_decals("three.csv", 1));
///
/// Threads: values, used as any other: read by several at once, or changed by one. Tables may be loaded by
/// several at once, and saved to different files.
namespace [[gnu::visibility("default")]] wrinkle {

/// [Mik20 4.5, figure 6] The surface's own normal is bumped; or the projector's axis is, and the two normals are mixed,
/// as engines do, to compare with.
enum class DecalMode { surface_gradient, projector };

/// Oriented box projector [Mik20 4.5]: a table of one row, a box. The image spans the box's x and y; it is projected
/// along z.
struct DecalLayer {
    static constexpr const char* kind = "decal";
    TextureUse texture{.wrap = Wrap::clamp};
    Vec3 center{};
    Vec3 axis_x{1, 0, 0}, axis_y{0, 1, 0};  ///< made orthonormal; axis_z = axis_x x axis_y points at the projector
    Vec3 half_size{0.5, 0.5, 0.5};          ///< metres
    double falloff = 0.1;                   ///< share of the half size over which it fades to the box's faces, [0,1]
    std::array<double, 2> angle_fade{0.25, 0.5};  ///< cosine of normal to axis_z: 0 below the first, 1 above the second
    bool two_sided = false;                       ///< false: nothing on surfaces that face away from the projector
    DecalMode mode = DecalMode::surface_gradient;
};

enum class ProjectorShape {
    box,     ///< projects along z
    sphere,  ///< the ellipsoid within the box; projects along z
    cone,    ///< a spot: apex in the middle of the box's +z face, base on its -z face; the image fans out from the apex
};
enum class ProjectorMode { add, replace };

/// One row of a table of decals.
struct Projector {
    ProjectorShape shape = ProjectorShape::box;
    std::uint32_t texture = 0;                 ///< into the layer's textures
    std::array<double, 4> region{0, 0, 1, 1};  ///< of that texture: s and t from, s and t to; whole texels
    Vec3 center{};                             ///< of the box, world
    Vec3 axis_x{1, 0, 0}, axis_y{0, 1, 0};     ///< as those of DecalLayer
    Vec3 half_size{0.5, 0.5, 0.5};             ///< metres; 0 or less: touches nothing
    double scale = 1;                          ///< metres for a height of 1; a plain factor for normals and slopes
    Vec3 falloff{0.1, 0.1, 0.1};               ///< share that fades: box x, y, z; sphere radius; cone radius, -, length
    std::array<double, 2> angle_fade{0.25, 0.5};  ///< as DecalLayer's
    bool two_sided = false;                       ///< false: nothing on surfaces that face away from the projector
    Wrap wrap = Wrap::clamp;
    std::array<double, 2> repeat{1, 1};  ///< times the region repeats over the box, with Wrap::repeat
    ProjectorMode mode = ProjectorMode::add;
    double opacity = 1;
    double priority = 0;             ///< lower ones first; equal ones in the order of the table
    std::optional<double> object{};  ///< only pixels with this object index
    std::string cryptomatte{};       ///< only this object, by its coverage; name, or "#" and 8 hex digits
    std::uint32_t line = 0;          ///< of the table's file, for messages; 0 in files without lines
};

/// The image of a projector on the device.
struct ProjectedImage {
    std::uint32_t texture = 0;  ///< number in the texture table
    bool height = false;  ///< it holds heights, whose slopes are per unit of texture; else slopes of metres over metres
};

/// Many decals. Those that add are independent of order; one that replaces takes g to g + (d - g) weight of what the
/// rows of the same table before it made.
struct DecalsLayer {
    static constexpr const char* kind = "decals";
    std::vector<TextureUse> textures{};  ///< slopes are metres over metres, whatever their unit says
    std::shared_ptr<const std::vector<Projector>> rows{};
    std::filesystem::path file{};  ///< that the rows are from, for messages; empty for rows made in code
};

/// Reads a table of decals: CSV, a row of column names, then a row a decal; TOML (.toml), a [[decal]] a row; or .npy,
/// records with fields named as the columns of CSV are; data/scenes/README.md lists them. Throws Error with the line
/// (.npy: the row) and column of each mistake, the first 20 of them. `textures`: how many textures rows may name.
std::vector<Projector> load_decals(const std::filesystem::path& file, std::size_t textures);

/// Writes one that load_decals reads back to the same numbers: TOML if it is named .toml, else CSV.
void save_decals(const std::filesystem::path& file, const std::vector<Projector>& rows);

}  // namespace wrinkle
