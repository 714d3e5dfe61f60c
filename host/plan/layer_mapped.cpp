#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kFrame = 70, kCombine = 90, kTaps = 240;  // expected operations

const char* combine_function(Combine combine) {
    switch (combine) {
        case Combine::whiteout:
            return "wr_combine_whiteout";
        case Combine::udn:
            return "wr_combine_udn";
        case Combine::linear:
            return "wr_combine_linear";
        default:
            return "wr_combine_rnm";
    }
}

/// Whether the layer goes by the planes of the renderer's tangents. They belong to the UV pass: its scale and offset do
/// not turn them, a rotation would.
bool vertex_frame(const LayerText& at, const NormalMapLayer& l) {
    const Emitter& emitter = at.emitter;
    const std::vector<std::string> tangent{"tangent.x", "tangent.y", "tangent.z"};
    const bool fits = l.uv.source == UvSource::aov && l.uv.rotation == 0;
    if (l.frame == TangentSource::planes) {
        if (!fits)
            throw Error(at.who +
                        ": frame = \"tangents\" belongs to the UV pass as it is, without rotation; use \"derived\"");
        emitter.need(at.who, tangent);
        if (!emitter.has("tangent_sign"))
            emitter.need(at.who + " (without tangent_sign)", {"bitangent.x", "bitangent.y", "bitangent.z"});
        return true;
    }
    return l.frame == TangentSource::automatic && fits &&
           std::ranges::all_of(tangent, [&](const auto& plane) { return emitter.has(plane); }) &&
           (emitter.has("tangent_sign") || emitter.has("bitangent.z"));
}

/// Unit axis along which a planar mapping projects.
Vec3 plane_axis(const UvMapping& uv) {
    Vec3 axis{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        axis[i] = uv.axis_u[j] * uv.axis_v[k] - uv.axis_u[k] * uv.axis_v[j];
    }
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    for (double& part : axis) part /= length;
    return axis;
}

std::string emit_taps(LayerText& at, const HeightMapLayer& l) {
    if (l.texture.wrap == Wrap::clamp) throw Error(at.who + ": upscale = \"taps\" repeats; wrap must not be \"clamp\"");
    at.section.operations += kTaps;
    return at.located(l.texture, TexelKind::height, l.uv) +
           fmt::format("        wr_vec2 dh = wr_height_taps(t, c.st, c.dx, c.dy, {});\n", at.lod("c.dx", "c.dy")) +
           at.slopes("from_screen_slope", "dh");
}

}  // namespace

std::string emit(LayerText& at, const NormalMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
    const bool planes = vertex_frame(at, l);
    if (planes) {
        at.section.reads.insert({"vertex_tb", "vertex_tb_valid"});
        for (const std::size_t i : {0u, 1u})  // a mirrored texture
            if (l.uv.scale[i] < 0) text += fmt::format("        slope.{0} = -slope.{0};\n", i == 0 ? 'x' : 'y');
        text += "        m = vertex_tb_valid ? m : (wr_real)(0);\n";
        at.section.operations += 8;
    } else {
        text += fmt::format("        wr_tangents f = wr_tangent_frame{}(n, dp_dx, dp_dy, c.dx, c.dy);\n", at.exactly());
        at.section.operations += kFrame;
        if (l.uv.source == UvSource::planar)
            text +=
                fmt::format("        m = wr_has_planar_frame(n, {}) ? m : (wr_real)(0);\n", literal(plane_axis(l.uv)));
    }
    const char* frame = planes ? "vertex_tb" : "f";
    if (l.combine == Combine::surface_gradient)
        return text + fmt::format("        g = wr_fma(wr_surface_gradient_from_tbn(slope, {}), m * {}, g);\n", frame,
                                  at.strength());
    at.section.operations += kCombine;
    at.section.reads.insert("dh_dp");
    return text + fmt::format(
                      "        wr_vec3 below = wr_add(g, wr_surface_gradient_from_volume(n, dh_dp));\n"
                      "        wr_vec3 detail = wr_scale(wr_surface_gradient_from_tbn(slope, {}), (wr_real)({}));\n"
                      "        g = wr_fma(wr_sub({}(below, detail), below), m, g);\n",
                      frame, at.strength(), combine_function(l.combine));
}

std::string emit(LayerText& at, const HeightMapLayer& l) {
    if (l.texture.upscale == Upscale::taps) return emit_taps(at, l);
    std::string text = at.textured(l.texture, l.uv);
    return text + at.slopes("scale_dependent", "c.dx, c.dy, slope");
}

}  // namespace wrinkle
