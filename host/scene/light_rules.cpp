#include "scene/light_rules.h"

#include <fmt/format.h>

#include "scene/light_extent.h"
#include "scene/table.h"

namespace wrinkle::scene {

void check_light(const Light& light, const LightFault& fault) {
    const LightKind kind = light.kind;
    if (kind == LightKind::disc && !(light.radius > 0)) fault({"radius"}, "must be positive for a disc");
    if (kind == LightKind::rectangle && !(light.size[0] > 0 && light.size[1] > 0))
        fault({"size"}, "must be positive for a rectangle");
    if (kind == LightKind::point || kind == LightKind::sphere || kind == LightKind::sky) return;
    if (light.direction == Vec3{}) return fault({"direction"}, "must not be zero; it is the way the light travels");
    if (kind == LightKind::rectangle && !crosses(light.up, light.direction))
        fault({"up"}, "must not be zero or along the direction; it is the way the height goes");
    if (kind == LightKind::spot && !(light.inner_angle < light.outer_angle))
        fault({"inner_angle", "outer_angle"},
              fmt::format("must leave inner_angle ({:.4g}) less than outer_angle ({:.4g} degrees from the axis)",
                          to_degrees(light.inner_angle), to_degrees(light.outer_angle)));
}

}  // namespace wrinkle::scene
