// sources/decal.clh followed by the projection onto the surface. (functions_test.cpp tests its functions one by one.)
#include "tests/cases/decal.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Decal, SurfaceGradient) {
    check(cases::decal_gradient_cases(),
          "global const wr_decal *decal = (global const wr_decal *)records;\n"
          "vec3 g = wr_decal_gradient(decal, slope, weight);\n"
          "vec3 s = wr_surface_gradient_from_volume(unit(n), g);",
          {{"sg", xyz("s"), ErrorMeasure::relative, 4e-7, 4e-7, 1e-9}});
}

}  // namespace
}  // namespace wrinkle::test
