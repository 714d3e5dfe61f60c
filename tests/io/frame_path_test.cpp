#include "io/frame_path.h"

#include <gtest/gtest.h>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

TEST(FramePath, FillsInTheNumber) {
    EXPECT_EQ(frame_path("a/b.####.exr", 7), "a/b.0007.exr");
    EXPECT_EQ(frame_path("a/b.%04d.exr", 12345), "a/b.12345.exr");
    EXPECT_EQ(frame_path("b%d.exr", 3), "b3.exr");
    EXPECT_EQ(frame_path("b_#.exr", -3), "b_-3.exr");
    EXPECT_EQ(frame_path("shot##/b.###.exr", 1), "shot##/b.001.exr");
    EXPECT_EQ(frame_path("v#2/plain.exr", 1), "v#2/plain.exr");
    EXPECT_EQ(frame_path("b.%12d.exr", 7), "b.000000000007.exr");
    EXPECT_EQ(frame_path("b.$F4.exr", 7), "b.0007.exr");
    EXPECT_EQ(frame_path("b_$F_v2.exr", 7), "b_7_v2.exr");
    EXPECT_EQ(frame_path("b.<frame>.exr", 7), "b.7.exr");
    EXPECT_EQ(frame_path("b.<frame04>.exr", 7), "b.0007.exr");
    EXPECT_TRUE(has_frame_pattern("b.####.exr"));
    EXPECT_FALSE(has_frame_pattern("b.$FOO.exr"));
    EXPECT_FALSE(has_frame_pattern("b.<frames>.exr"));
    EXPECT_FALSE(has_frame_pattern("b%.exr"));
    EXPECT_FALSE(has_frame_pattern("shot##/b.exr"));
}

TEST(FramePath, AFileOfThatVeryNameWins) {
    const test::TempFolder folder;
    const auto file = folder / "shot#2.exr";
    EXPECT_EQ(frame_path(file, 1), folder / "shot12.exr");
    test::write_text(file, "");
    EXPECT_FALSE(has_frame_pattern(file));
    EXPECT_EQ(frame_path(file, 1), file);
    EXPECT_EQ(with_frame(file.filename(), 1), "shot12.exr");
}

}  // namespace
}  // namespace wrinkle
