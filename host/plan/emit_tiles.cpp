#include <fmt/format.h>

#include <algorithm>

#include "plan/geometry_text.h"
#include "plan/layer_text.h"
#include "plan/stored_planes.h"

namespace wrinkle {

namespace {

constexpr const char* kLoad = "wr_load_near({}, here, pixels)";
const std::string kIndent(12, ' ');

/// Whether a table of decals is evaluated at several points of a pixel's area.
bool over_area(const Emitter& emitter) {
    return std::ranges::any_of(emitter.scene.layers, [&](const Layer& layer) {
        return emitter.kind(layer).binned && varies_over_area(emitter, layer);
    });
}

/// Text that grows the tile's box around both ends of the pixel's area.
std::string grow_area_text(const Emitter& emitter, const GeometryText& geometry) {
    std::string text = kIndent +
                       "wr_vec3 n = wr_renormalize(wr_select(valid, wr_v3(wr_to_real(nx), wr_to_real(ny), "
                       "wr_to_real(nz)), wr_v3((wr_real)(0), (wr_real)(0), (wr_real)(1)))), dp_dx, dp_dy;\n" +
                       kIndent + "const struct { wr_real x, y; } at = {x, y};\n" + kIndent + "{\n" +
                       face_viewer_text(emitter) + derivative_text(emitter, geometry.along) + kIndent + "}\n" +
                       axis_text(emitter);
    for (const char* end : {"first", "last"})
        text += fmt::format("{}box = wr_grow(box, valid, wr_fma(taps.along, wr_on_plane(taps, taps.{}), p), axes);\n",
                            kIndent, end);
    return text;
}

/// Text that grows the tile's box around p, or around the stretch of its ray on which parallaxes may move it.
std::string grow_text(const Emitter& emitter, const MovedPoints& moved) {
    if (moved.text.empty()) return kIndent + "box = wr_grow(box, valid, p, axes);\n";
    const bool parallel = emitter.available.camera == CameraKind::parallel;
    std::string text = fmt::format(
        "{0}wr_vec3 v = {1};\n"
        "{0}wr_real distance = sqrt(wr_dot(p, p)), nearer = 0, farther = 0;\n{2}",
        kIndent, to_viewer_text(emitter),
        moved.by_normal ? kIndent +
                              "wr_vec3 n = wr_normalize(wr_select(valid, wr_v3(wr_to_real(nx), wr_to_real(ny), "
                              "wr_to_real(nz)), v));\n"
                        : "");
    text += moved.text;
    for (const char* way : {"nearer", "-farther"})
        text +=
            fmt::format("{}box = wr_grow(box, valid, {}, axes);\n", kIndent,
                        parallel ? fmt::format("wr_fma(v, {}, p)", way)
                                 : fmt::format("wr_scale(p, distance > 0 ? 1 - ({}) / distance : (wr_real)(1))", way));
    return text;
}

}  // namespace

PlannedKernel emit_tiles(Emitter& emitter, std::string& source) {
    const GeometryText geometry = geometry_text(emitter);
    const MovedPoints moved = moved_points(emitter, kIndent);
    std::vector<std::string> inputs = geometry.planes;
    const bool area = over_area(emitter), normals = moved.by_normal || area;
    if (normals) inputs.insert(inputs.end(), {"normal.x", "normal.y", "normal.z"});
    // All tables share the tiles: those over areas, those at points that a parallax has moved, and lights, which reach
    // a pixel where they reach its centre.
    std::string grow = area ? fmt::format("{0}{{\n{1}{0}}}\n", kIndent, grow_area_text(emitter, geometry)) : "";
    if (!area || !moved.text.empty() || has_light_table(emitter)) grow += grow_text(emitter, moved);
    const PlaneFormats& formats = emitter.plan.formats;
    source += fmt::format(
        R"(wr_kernel void wr_bin_tiles(constant const wr_camera *camera, constant const WR_SCALAR *numbers,
    constant const WR_SCALAR *axes, global float *bounds,
    uint tiles, uint supers,
{}    uint in_first, uint in_pixels, uint first_row, uint width, uint rows)
{{
    uint tile = get_global_id(0);
    if (tile >= tiles) return;
{}    uint2 corner = wr_tile_corner(tile, supers);
    wr_growing box = wr_no_box();
    for (uint row = corner.y; row < min(corner.y + WR_TILE_HEIGHT, rows); ++row)
        for (uint column = corner.x; column < min(corner.x + WR_TILE_WIDTH, width); column += WR_LANES) {{
            long here = (long)in_first + (long)row * width + column, pixels = in_pixels;
            wr_real x = wr_lane_number() + (wr_real)(column + WR_R(0.5)), y = (wr_real)(first_row + row + WR_R(0.5));
{}            wr_mask valid = {}{} & (x < width);
{}            {}
{}        }}
    wr_store_bounds(box, bounds, tiles, tile);
}}

)",
        input_arguments(inputs, formats), input_declarations(inputs, formats),
        load_geometry(geometry, kLoad, kIndent) + (normals ? load_normal(kLoad, kIndent) : ""),
        normals ? "wr_valid_normal(nx, ny, nz) & " : "", geometry.valid, sanitize(geometry, kIndent), geometry.position,
        grow);
    return {"wr_bin_tiles", memories_of(inputs, formats), {}, {}, 0};
}

PlannedKernel emit_bins(Emitter& emitter, std::string& source) {
    const PlannedKernel tiles = emit_tiles(emitter, source);
    const char* binned =
        "global const float *boxes, global const float *bounds, global const float *groups, uint decals,\n"
        "    global uint *entries, uint capacity, global uint *used";
    source += fmt::format(
        R"(wr_kernel void wr_bin_parents(global const float *child_bounds, global float *bounds, uint parents)
{{
    if (get_global_id(0) < parents)
        wr_bin_around(child_bounds, 16 * parents, get_global_id(0), bounds, parents);
}}

wr_kernel void wr_bin_supers({0},
    global const float *tile_bounds, uint tiles, global uint *lists)
{{
    wr_binned all = {{boxes, bounds, groups, decals}};
    if (get_global_id(0) < tiles)
        wr_bin_super(all, tile_bounds, tiles, get_global_id(0), lists, entries, capacity, used);
}}

wr_kernel void wr_bin_lists({0},
    global const float *child_bounds, uint parents, global const uint *parent_lists, global uint *child_lists,
    global ushort *hits)
{{
    wr_binned all = {{boxes, bounds, groups, decals}};
    if (get_global_id(0) < parents)
        wr_bin_children(all, child_bounds, 16 * parents, get_global_id(0), parent_lists, child_lists, entries, hits,
                        capacity, used);
}}

)",
        binned);
    return tiles;
}

}  // namespace wrinkle
