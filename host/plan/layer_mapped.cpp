#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kFrame = 70, kScaleDependent = 85, kCombine = 90;  // expected operations

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
}  // namespace

std::string emit(LayerText& at, const NormalMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
    at.section.operations += kFrame;
    text += "        wr_frame_tb f = wr_tangent_frame(n, dp_dx, dp_dy, c.dx, c.dy);\n";
    if (l.combine == Combine::surface_gradient)
        return text +
               fmt::format("        g = wr_fma(wr_surface_gradient_from_tbn(slope, f), m * {}, g);\n", at.strength());
    at.section.operations += kCombine;
    at.section.reads.insert("dh_dp");
    return text + fmt::format(
                      "        vec3 below = wr_add(g, wr_surface_gradient_from_volume(n, dh_dp));\n"
                      "        vec3 detail = wr_scale(wr_surface_gradient_from_tbn(slope, f), (real)({}));\n"
                      "        g = wr_fma(wr_sub({}(below, detail), below), m, g);\n",
                      at.strength(), combine_function(l.combine));
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
