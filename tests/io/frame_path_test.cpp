#include "io/frame_path.h"

#include <gtest/gtest.h>

namespace wrinkle {
namespace {

TEST(FramePath, FillsInTheNumber) {
    EXPECT_EQ(frame_path("a/b.####.exr", 7), "a/b.0007.exr");
    EXPECT_EQ(frame_path("a/b.%04d.exr", 12345), "a/b.12345.exr");
    EXPECT_EQ(frame_path("b%d.exr", 3), "b3.exr");
    EXPECT_EQ(frame_path("b_#.exr", -3), "b_-3.exr");
    EXPECT_EQ(frame_path("shot##/b.###.exr", 1), "shot##/b.001.exr");
    EXPECT_EQ(frame_path("v#2/plain.exr", 1), "v#2/plain.exr");
    EXPECT_TRUE(has_frame_pattern("b.####.exr"));
    EXPECT_FALSE(has_frame_pattern("b%.exr"));
}

}  // namespace
}  // namespace wrinkle
