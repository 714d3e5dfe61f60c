#include <fmt/format.h>

#include <algorithm>

#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kFrame = 70, kScaleDependent = 85;  // expected operations

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

}  // namespace

std::string emit(LayerText& at, const NormalMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
    if (vertex_frame(at, l)) {
        at.section.reads.insert({"vertex_tb", "vertex_tb_valid"});
        for (const std::size_t i : {0u, 1u})  // a mirrored texture
            if (l.uv.scale[i] < 0) text += fmt::format("        slope.{0} = -slope.{0};\n", i == 0 ? 'x' : 'y');
        at.section.operations += 8;
        return text + fmt::format(
                          "        m = vertex_tb_valid ? m : (real)(0);\n"
                          "        g = wr_fma(wr_surface_gradient_from_tbn(slope, vertex_tb), m * {}, g);\n",
                          at.strength());
    }
    at.section.operations += kFrame;
    return text + fmt::format(
                      "        wr_frame_tb f = wr_tangent_frame(n, dp_dx, dp_dy, c.dx, c.dy);\n"
                      "        g = wr_fma(wr_surface_gradient_from_tbn(slope, f), m * {}, g);\n",
                      at.strength());
}

std::string emit(LayerText& at, const HeightMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
    at.section.operations += kScaleDependent;
    return text + fmt::format(
                      "        vec3 bump = wr_surface_gradient_scale_dependent(n, dp_dx, dp_dy, c.dx, c.dy, slope);\n"
                      "        g = wr_fma(bump, m * {}, g);\n",
                      at.strength());
}

}  // namespace wrinkle
