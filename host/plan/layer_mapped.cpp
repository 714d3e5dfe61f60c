#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kFrame = 70, kScaleDependent = 85;  // expected operations
}

std::string emit(LayerText& at, const NormalMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
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
