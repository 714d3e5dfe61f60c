#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kScaleDependent = 85, kTextureMetres = 60;  // expected operations
}

std::string emit(LayerText& at, const DerivativeMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
    at.section.operations += kScaleDependent;
    if (l.auto_scale) {
        text += fmt::format("        slope = wr_scale(slope, wr_texture_metres(dp_dx, dp_dy, c.dx, c.dy){});\n",
                            l.texture.unit == SlopeUnit::texel ? " / wr_texels_across(t)" : "");
        at.section.operations += kTextureMetres;
    }
    return text + fmt::format(
                      "        vec3 bump = wr_surface_gradient_scale_dependent(n, dp_dx, dp_dy, c.dx, c.dy, slope);\n"
                      "        g = wr_fma(bump, m * {}, g);\n",
                      at.strength());
}

}  // namespace wrinkle
