// sources/triplanar.clh
#include "tests/cases/triplanar.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

const std::vector<std::string> includes{"surface/tangent_frame.clh", "surface/surface_gradient.clh",
                                        "sources/triplanar.clh"};

TEST(Triplanar, Weights) {
    cases::WeightCases c = cases::triplanar_weight_cases();
    KernelData data;
    data.constants = std::move(c.sharpness);
    data.constants_per_row = 1;
    const double bound = cases::triplanar_weight_absolute;
    check(c.cases, includes, "vec3 w = wr_triplanar_weights(n, constants[0]);",
          {{"w", xyz("w"), Metric::absolute, bound, bound, 1e-12}}, data, 4);
}

TEST(Triplanar, Gradient) {
    check(cases::triplanar_gradient_cases(), includes,
          "vec3 g = wr_triplanar_gradient(w, dx, dy, dz);\n"
          "vec3 s = wr_surface_gradient_from_volume(unit(n), g);",
          {{"sg", xyz("s"), Metric::relative, 3e-7, 3e-7, 1e-9}});
}

}  // namespace
}  // namespace wrinkle::test
