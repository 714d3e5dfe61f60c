#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/imath.h"
#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kFrame = 70, kCombine = 90;  // expected operations

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

/// Whether the layer uses the renderer's tangents, which are planes of the frame. They go along u and v, so they do not
/// serve a mapping that rotates these; scale and offset do not matter.
bool vertex_frame(const LayerText& at, const NormalMapLayer& l) {
    const Emitter& emitter = at.emitter;
    const std::vector<std::string> tangent{"tangent.x", "tangent.y", "tangent.z"};
    const bool fits = l.uv.source == UvSource::aov && l.uv.rotation == 0;
    if (l.tangents == TangentSource::planes) {
        if (!fits)
            throw Error(at.who +
                        ": tangents = \"passes\" belong to the UV pass as it is, without rotation; use \"derived\"");
        emitter.need(at.who, tangent);
        if (!emitter.has("tangent_sign"))
            emitter.need(at.who + " (without tangent_sign)", {"bitangent.x", "bitangent.y", "bitangent.z"});
        return true;
    }
    return l.tangents == TangentSource::automatic && fits &&
           std::ranges::all_of(tangent, [&](const auto& plane) { return emitter.has(plane); }) &&
           (emitter.has("tangent_sign") || emitter.has("bitangent.z"));
}

/// Unit axis along which a planar mapping projects.
Vec3 plane_axis(const UvMapping& uv) { return to_array(direction(to_imath(uv.axis_u).cross(to_imath(uv.axis_v)))); }

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<NormalMapLayer>(layer);
    scene::read_texture_of(table, bump.texture, Content::normal);
    scene::read_green(table, bump.texture);
    scene::read_mapped(table, bump.texture, bump.uv);
    table.choose("combine", bump.combine,
                 {{"surface_gradient", Combine::surface_gradient},
                  {"whiteout", Combine::whiteout},
                  {"udn", Combine::udn},
                  {"rnm", Combine::rnm},
                  {"linear", Combine::linear}});
    table.choose(
        "tangents", bump.tangents,
        {{"auto", TangentSource::automatic}, {"derived", TangentSource::derived}, {"passes", TangentSource::planes}});
    if (bump.tangents == TangentSource::automatic) table.compiled_in("uv.rotation", bump.uv.rotation != 0);
    if (bump.tangents == TangentSource::planes && (bump.uv.source != UvSource::aov || bump.uv.rotation != 0))
        table.complain("tangents",
                       "is \"passes\", which belong to the UV pass as it is: uv must not be planar or turn");
    scene::read_weight(table, layer);
    layer.bump = bump;
}

std::string emit(LayerText& at) {
    const auto& l = std::get<NormalMapLayer>(at.layer.bump);
    std::string text = at.textured(l.texture);
    const bool planes = vertex_frame(at, l);
    std::string frame = "vertex_tb";
    if (planes) {
        at.section.reads.insert({"vertex_tb", "vertex_tb_valid"});
        const std::size_t mirror = at.emitter.numbers(at.layer, "mirroring by uv", [](const Layer& layer, const auto&) {
            const UvMapping& uv = own_uv(layer);
            return std::vector<double>{uv.scale[0] < 0 ? -1.0 : 1.0, uv.scale[1] < 0 ? -1.0 : 1.0};
        });
        text += fmt::format(
            "        slope.x *= numbers[{}], slope.y *= numbers[{}];\n"
            "        m = vertex_tb_valid ? m : (wr_real)(0);\n",
            mirror, mirror + 1);
        if (at.tells_spread())
            text += fmt::format("        lost.y *= numbers[{}] * numbers[{}];\n", mirror, mirror + 1);
        at.section.operations += 8;
    } else {
        frame = at.once("wr_tangents", "frame",
                        fmt::format("wr_tangent_frame{}(n, dp_dx, dp_dy, c.dx, c.dy)", at.exactly()));
        if (!at.over_area()) text += fmt::format("        wr_tangents f = {};\n", std::exchange(frame, "f"));
        at.section.operations += kFrame;
        if (l.uv.source == UvSource::planar)
            text += fmt::format(
                "        m = wr_has_planar_frame(n, {}) ? m : (wr_real)(0);\n",
                at.vector("axis of the planar uv", [](const Layer& layer) { return plane_axis(own_uv(layer)); }));
    }
    const auto along = [&](const char* unit) {
        return fmt::format("wr_surface_gradient_from_tbn({}, {})", unit, frame);
    };
    text += at.spread(along("wr_v2((wr_real)(1), (wr_real)(0))"), along("wr_v2((wr_real)(0), (wr_real)(1))"));
    if (l.combine == Combine::surface_gradient)
        return text + fmt::format("        g = wr_fma(wr_surface_gradient_from_tbn(slope, {}), m * {}, g);\n", frame,
                                  at.strength());
    at.section.operations += kCombine;
    return text + fmt::format(
                      "        wr_vec3 below = {};\n"
                      "        wr_vec3 detail = wr_scale(wr_surface_gradient_from_tbn(slope, {}), (wr_real)({}));\n"
                      "        g = wr_fma(wr_sub({}(below, detail), below), m, g);\n",
                      at.below(), frame, at.strength(), combine_function(l.combine));
}

constexpr const char* tangent_roles[] = {"uv", "tangent", "tangent_sign or bitangent"};
constexpr LayerUse uses[] = {{"", layers::uv_role}, {"tangents = \"passes\"", tangent_roles}};

}  // namespace

const LayerKind& layers::normal_map() {
    static constexpr LayerKind row = layers::slopes_on_uv(NormalMapLayer::kind, read, emit, uses);
    return row;
}

}  // namespace wrinkle
