// sources/projector.clh followed by the projection onto the surface. (functions_test.cpp tests its functions one by
// one.)
#include "tests/cases/decal.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Projector, SurfaceGradient) {
    check(cases::projector_golden_cases(),
          "global const wr_projector *decal = (global const wr_projector *)records;\n"
          "wr_vec3 g = wr_projector_blend(decal, wr_project(decal, p), slope, weight, wr_zero3());\n"
          "wr_vec3 s = wr_surface_gradient_from_volume(unit(n), g);",
          {{"sg", xyz("s"), ErrorMeasure::relative, 4e-7, 4e-7, 1e-9}});
}

}  // namespace
}  // namespace wrinkle::test
