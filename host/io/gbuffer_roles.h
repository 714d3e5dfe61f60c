#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/metadata.h"
#include "wrinkle/gbuffer.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// The program that wrote a G-buffer, as far as the names of its channels tell; `plain` when no known one uses them.
enum class Writer { plain, blender, mitsuba, pbrt, renderman, arnold, unreal, vray };

std::string_view writer_name(Writer writer);  ///< "Blender Cycles", "pbrt-v4", ... "plain names"

/// Which channel of the file holds which plane, and what the writer means by it.
struct RoleMap {
    Writer writer = Writer::plain;
    std::map<std::string, std::string, std::less<>> channel_of;  ///< "normal.x" -> "ViewLayer.Normal.X"
    DepthKind depth = DepthKind::planar;                         ///< planar or ray, never automatic
    bool camera_space_normals = false;                           ///< as V-Ray's: x right, y up, z towards the viewer
    bool v_down = false;            ///< the second texture coordinate grows downwards, as Mitsuba's
    std::string cryptomatte_layer;  ///< "ViewLayer.CryptoObject", without the rank digits; empty without any
    int cryptomatte_ranks = 0;      ///< number of ranks, each with planes crypto.idN and crypto.coverageN

    bool has_plane(std::string_view plane) const { return channel_of.contains(plane); }
    bool has_role(std::string_view role) const;  ///< all of its planes; "cryptomatte": at least one rank
};

/// What a file's header says of its channels.
struct HeaderHints {
    std::vector<std::string> cryptomattes{};  ///< names of layers, from cryptomatte/KEY/name
    bool vray = false;                        ///< it has attributes of V-Ray
    bool mitsuba = false;                     ///< it says that Mitsuba wrote it
};
HeaderHints header_hints(const Metadata& header);

/// Finds the planes of gbuffer_roles() among a file's channels.
///
/// Shading normals are preferred to geometric ones (Mitsuba sh_normal to geo_normal, pbrt Ns to N), since bumps on a
/// faceted normal show its facets. Of several view layers the one with most roles is used, or source.layer, for all
/// roles: layers are mixed only where source.roles say so.
///
/// `source.roles`: by role ("position") a layer ("ViewLayer.Position"), or a channel if the role has one plane; by
/// single plane ("uv.u") a channel; "none" leaves a role out. Throws Error when one of them matches nothing, when there
/// is no such view layer, and when two view layers have as much and source says nothing of it.
RoleMap detect_roles(std::span<const std::string> channels, const GBufferSource& source = {},
                     const HeaderHints& hints = {});

}  // namespace wrinkle
