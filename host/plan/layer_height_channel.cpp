#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

std::string emit(LayerText& at, const HeightChannelLayer& l) {
    const std::string plane = "channel:" + l.channel;
    at.emitter.need(at.who, {plane});
    std::string text = emit_height_taps(at.emitter, plane, at.section);
    at.section.reads.insert({"n", "dp_dx", "dp_dy", "g"});
    at.section.writes.insert("g");
    at.section.operations += 70;
    return text + fmt::format(
                      "        vec3 bump = wr_surface_gradient_from_screen_slope(n, dp_dx, dp_dy, dh);\n"
                      "        g = wr_fma(bump, m * {}, g);\n",
                      at.strength());
}

}  // namespace wrinkle
