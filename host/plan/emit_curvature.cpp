#include "plan/section.h"

namespace wrinkle {

bool spreads_by_curvature(const Emitter& emitter) { return emitter.scene.filter.curvature && wants_spread(emitter); }

Section emit_curvature() {
    Section section;
    section.title = "curvature of the base surface";
    section.reads = {"valid", "n", "dp_dx", "dn_dx", "dn_dy"};
    section.writes = {"spread"};
    section.operations = 40;
    section.body =
        "        wr_vec3 right = wr_normalize(dp_dx), down = wr_cross_fast(right, n);\n"
        "        spread = wr_select(valid, wr_curvature_spread(dn_dx, dn_dy, right, down), wr_zero3());\n";
    return section;
}

}  // namespace wrinkle
