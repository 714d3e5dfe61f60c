#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

std::string emit(LayerText& at, const HeightChannelLayer& l) {
    const std::string plane = "channel:" + l.channel;
    at.emitter.need(at.who, {plane});
    return emit_height_taps(at.emitter, plane, at.section) + at.slopes("from_screen_slope", "dh");
}

}  // namespace wrinkle
