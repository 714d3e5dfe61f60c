#include "run/shrink_rows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wrinkle {
namespace {

TEST(ShrinkRows, TakesMeansDirectionsAndBits) {
    const std::vector<std::string> names{"out:normal.x", "out:normal.y", "out:normal.z", "out:marked", "out:lit.r"};
    // Two pixels of two by two: 0 1 4 5 and 2 3 6 7 of the rows below.
    const std::vector<std::vector<float>> given{{1, 0, 0, 0, 1, 0, 0, 0},
                                                {0, 1, 0, 0, 0, 1, 0, 0},
                                                {0, 0, 1, -1, 0, 0, 1, -1},
                                                {0, 1, 4, 0, 8, 1, 0, 4},
                                                {1, 2, 0, 0, 3, 4, 0, 8}};
    std::vector<const float*> planes;
    for (const std::vector<float>& plane : given) planes.push_back(plane.data());
    const auto few = shrink_rows(names, planes, 4, 2, 2);
    ASSERT_EQ(few.size(), names.size());
    const float half = std::sqrt(0.5f);
    EXPECT_FLOAT_EQ(few[0][0], half);
    EXPECT_FLOAT_EQ(few[1][0], half);
    EXPECT_EQ(few[2][0], 0);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(few[axis][1], 0) << "normals that cancel each other";
    EXPECT_EQ(few[3], (std::vector<float>{9, 4}));
    EXPECT_EQ(few[4], (std::vector<float>{2.5f, 2}));
}

}  // namespace
}  // namespace wrinkle
