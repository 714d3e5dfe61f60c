// surface/tangent_frame.clh
#include "tests/cases/tangent_frame.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(TangentFrame, IsOrthonormalAndFollowsTheTextureCoordinates) {
    const double bound = cases::tangent_frame_degrees;
    check(cases::tangent_frame_cases(), {"surface/tangent_frame.clh"},
          "wr_frame_tb f = wr_tangent_frame(unit(n), dp_dx, dp_dy, dst_dx, dst_dy);",
          {{"T", xyz("f.t"), Metric::angle, bound, bound, 1e-9}, {"B", xyz("f.b"), Metric::angle, bound, bound, 1e-9}});
}

}  // namespace
}  // namespace wrinkle::test
