#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

namespace {
constexpr double kTextureMetres = 60;  // expected operations
}

std::string emit(LayerText& at, const DerivativeMapLayer& l) {
    std::string text = at.textured(l.texture, l.uv);
    if (l.auto_scale) {
        text += fmt::format("        slope = wr_scale(slope, wr_texture_metres(dp_dx, dp_dy, c.dx, c.dy){});\n",
                            l.texture.unit == SlopeUnit::texel ? " / wr_texels_across(t)" : "");
        at.section.operations += kTextureMetres;
    }
    return text + at.slopes("scale_dependent", "c.dx, c.dy, slope");
}

}  // namespace wrinkle
