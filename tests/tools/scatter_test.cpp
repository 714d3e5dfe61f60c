#include "tools/scatter.h"

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

TEST(Scatter, GivesTheSameRowsForTheSameSeedAndKeepsTheirDistance) {
    const HostFrame frame = small_frame();
    ScatterOptions options;
    options.count = 200;
    options.spacing = 0.2;
    const auto rows = scatter_decals(options, frame.frame, frame.planes());
    const auto again = scatter_decals(options, frame.frame, frame.planes());
    ASSERT_EQ(rows.size(), 200u);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].center, again[i].center);
        EXPECT_EQ(rows[i].axis_x, again[i].axis_x);
        for (std::size_t k = 0; k < i; ++k) {
            const V gap = reference::from_array<double>(rows[i].center) - reference::from_array<double>(rows[k].center);
            EXPECT_GE(length(gap), 0.2 - 1e-6) << i << ", " << k;
        }
    }
    options.seed = 2;
    EXPECT_NE(scatter_decals(options, frame.frame, frame.planes()).front().center, rows.front().center);
}

}  // namespace
}  // namespace wrinkle::test
