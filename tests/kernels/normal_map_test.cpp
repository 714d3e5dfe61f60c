// sources/normal_map.clh
#include "tests/cases/tangent_normal.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(NormalMap, SlopeOfATangentNormal) {
    check(cases::tangent_normal_cases(), {"sources/normal_map.clh"}, "vec2 d = wr_tangent_normal_slope(m);",
          {{"slope", xy("d"), Metric::relative, cases::tangent_normal_relative, cases::tangent_normal_relative}});
}

}  // namespace
}  // namespace wrinkle::test
