// compose/resolve.clh
#include "tests/cases/resolve.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(Resolve, IsTheNormalOfTheBumpedSurface) {
    check(cases::resolve_cases(), {"compose/resolve.clh"}, "vec3 r = wr_resolve(n, sg);",
          {{"N", xyz("r"), Metric::angle, cases::resolve_degrees, cases::resolve_degrees}});
}

}  // namespace
}  // namespace wrinkle::test
