// sources/decal.clh
#include "tests/cases/decal.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

const std::string record = "global const wr_decal *decal = (global const wr_decal *)records;\n";

TEST(Decal, Gradient) {
    check(cases::decal_gradient_cases(),
          record +
              "vec3 g = wr_decal_gradient(decal, d, (real)(1));\n"
              "vec3 s = wr_surface_gradient_from_volume(unit(n), g);",
          {{"sg", xyz("s"), ErrorMeasure::relative, 4e-7, 4e-7, 1e-9}});
}

/// The point and the centre cancel to 1e-6 of the half size: eye-relative positions lie up to 10 half sizes away.
TEST(Decal, BoxAndFades) {
    check(cases::decal_box_cases(),
          record +
              "wr_decal_point in_box = wr_decal_locate(decal, p);\n"
              "vec2 step = wr_decal_step(decal, dp);\n"
              "real fall = wr_decal_falloff(decal, in_box), fade = wr_decal_angle_fade(decal, unit(n));",
          {{"q", xyz("in_box.q"), ErrorMeasure::absolute, 1e-5, 1e-5},
           {"st", xy("in_box.st"), ErrorMeasure::absolute, 1e-5, 1e-5},
           {"step", xy("step"), ErrorMeasure::relative, 1e-6, 1e-6},
           {"inside", {"truth(in_box.inside)"}, ErrorMeasure::absolute, 0, 0, 0},
           {"falloff", {"fall"}, ErrorMeasure::absolute, 1e-4, 1e-4},
           {"angle_fade", {"fade"}, ErrorMeasure::absolute, 4e-6, 4e-6}});
}

}  // namespace
}  // namespace wrinkle::test
