#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Names of the planes that travel between files, plans and kernels. A plane is one float per pixel, row by row.
///
///   role        planes                             meaning, unit
///   position    position.x .y .z                   world, metres
///   normal      normal.x .y .z                     world; any length, either side
///   depth       depth                              planar view depth or ray distance, metres
///   uv          uv.u uv.v                          texture coordinates, v up
///   object      object                             object index
///   duv_dx/_dy  duv_dx.u duv_dx.v ...              screen derivatives of uv, per pixel right / down
///   dp_du/_dv   dp_du.x .y .z ...                  position per unit u / v
///   tangent     tangent.x .y .z                    world; as the renderer interpolated it, not normalised (mikkTSpace)
///   tangent_sign  tangent_sign                     above 0: bitangent = normal x tangent; else the other way round
///   bitangent   bitangent.x .y .z                  world; instead of tangent_sign
///   albedo      albedo.r .g .b                     diffuse reflectance, linear
///   roughness   roughness                          perceptual, GGX alpha = roughness^2
///   metallic    metallic                           1 where the surface is metal
///   emission    emission.r .g .b                   what surfaces give off, linear
///   transmission  transmission.r .g .b             what shows through surfaces: glass, water; or in three parts,
///   transmission_direct, _indirect, _color         ... direct and indirect light, and the colour that both are times
///   specular    specular.r .g .b                   what surfaces mirror, of the lights and of all around; or in
///   specular_direct, _indirect, _color             ... three such parts
///   beauty      beauty.r .g .b                     the finished picture, linear
///   cryptomatte crypto.id0 crypto.coverage0 ...    ranked pairs; id is float bits
/// Beside these, crypto.front has the id of the object whose surface the geometry is of (0: none is known); without it
/// that is taken to be crypto.id0.
/// Any other channel of the file is the plane "channel:NAME".
///
///     for (const wrinkle::Role& role : wrinkle::gbuffer_roles())
///         std::cout << role.name << " has " << role.planes.size() << " planes\n";
///
/// Threads: the table of roles is made at the first call and stays; all of them may read it.
namespace [[gnu::visibility("default")]] wrinkle {

/// A role with its planes; the table of the comment above as data.
struct Role {
    std::string name;
    std::vector<std::string> planes;
};

const std::vector<Role>& gbuffer_roles();

/// Bits of the `marked` output plane, added up as a float.
///
///     const bool background = (static_cast<int>(marked[0]) & wrinkle::Marked::invalid) != 0;
struct Marked {
    static constexpr int invalid = 1;      ///< background, NaN, Inf, zero normal: the normal passes through
    static constexpr int back_facing = 2;  ///< the normal faced away and was reflected towards the viewer
    static constexpr int overflow = 8;     ///< a gradient too large for a float: the normal stays as it was
    static constexpr int no_uv_derivative =
        4;  ///< no usable neighbour for a bare UV plane or a height, no tangent, or a layer's gradient that is not
            ///< finite: layers that need it are zero here
    static constexpr int picture_hole = 16;  ///< the picture to relight was not finite: it counts as black
};

}  // namespace wrinkle
