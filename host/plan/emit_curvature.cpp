#include "plan/section.h"

namespace wrinkle {

/// Light leaves it out: the picture that is relit shows the base surface's own curvature already.
bool spreads_by_curvature(const Emitter& emitter) {
    const Scene& scene = emitter.scene;
    const bool written = scene.output.roughness || scene.output.slope_covariance;
    return emitter.options.write_normal && scene.filter.curvature && written;
}

Section emit_curvature() {
    Section section;
    section.title = "curvature of the base surface";
    section.reads = {"valid", "n", "dp_dx", "dn_dx", "dn_dy"};
    section.writes = {"turning"};
    section.operations = 40;
    section.body =
        "        wr_vec3 right = wr_normalize(dp_dx), down = wr_cross_fast(right, n);\n"
        "        turning = wr_select(valid, wr_curvature_spread(dn_dx, dn_dy, right, down), wr_zero3());\n";
    return section;
}

}  // namespace wrinkle
