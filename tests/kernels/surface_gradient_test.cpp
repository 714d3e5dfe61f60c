// surface/surface_gradient.clh
#include "tests/cases/surface_gradient.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

const std::vector<std::string> includes{"surface/tangent_frame.clh", "surface/surface_gradient.clh"};

TEST(SurfaceGradient, FromTbn) {
    check(cases::tbn_cases(), includes,
          "wr_frame_tb f = {T, B};\n"
          "vec3 g = wr_surface_gradient_from_tbn(d, f);",
          {{"sg", xyz("g"), Metric::relative, 2e-7, 2e-7}});
}

TEST(SurfaceGradient, ScaleDependent) {
    const double bound = cases::scale_dependent_degrees;
    check(cases::scale_dependent_cases(), includes,
          "vec2 dh_dst = wr_v2(deriv.x * dim.x, deriv.y * dim.y);\n"
          "vec3 g = wr_surface_gradient_scale_dependent(unit(n), dp_dx, dp_dy, dst_dx, dst_dy, dh_dst);",
          {{"sg", xyz("g"), Metric::resolved, bound, bound, 1e-9},
           {"sg", xyz("g"), Metric::angle, bound, bound, 1e-9},
           {"sg", xyz("g"), Metric::relative, cases::scale_dependent_relative, cases::scale_dependent_relative, 1e-9}});
}

TEST(SurfaceGradient, FromVolume) {
    check(cases::volume_gradient_cases(), includes, "vec3 s = wr_surface_gradient_from_volume(unit(n), g);",
          {{"sg", xyz("s"), Metric::relative, cases::volume_gradient_relative, cases::volume_gradient_relative, 2e-9}});
}

}  // namespace
}  // namespace wrinkle::test
