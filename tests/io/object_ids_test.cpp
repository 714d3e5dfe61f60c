#include "io/object_ids.h"

#include <gtest/gtest.h>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace wrinkle::io {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(ObjectIds, LabelsKeepAll32Bits) {
    EXPECT_EQ(object_label(0), 0.0f);
    EXPECT_EQ(object_label(16777216), 16777216.0f);
    EXPECT_EQ(object_label(-1), -1.0f);
    EXPECT_EQ(object_label(2.5), 2.5f);
    EXPECT_NE(object_label(16777217), object_label(16777216));
    EXPECT_NE(object_label(16777217), object_label(16777218));
    for (const double number : {16777217.0, 1e9, 2147483648.0, 2139095040.0, 4290772992.0, 4294967295.0}) {
        EXPECT_TRUE(std::isnormal(object_label(number))) << number;  // kernels may flush denormals, and compare NaN
        EXPECT_EQ(object_number(object_label(number)), number);
    }
    EXPECT_EQ(object_number(object_label(7)), 7);
}

TEST(ObjectIds, NearlyWholeFloatsAreMeantToBeWhole) {
    std::vector<float> values{2.9999998f, 3.0000002f, 3.0009f, 2.5f, -0.0f, nan, 2047.9998f};
    EXPECT_EQ(object_storage(values), ObjectStorage::single);
    label_objects(values, ObjectStorage::single);
    EXPECT_EQ(values[0], 3.0f);
    EXPECT_EQ(values[1], 3.0f);
    EXPECT_EQ(values[2], 3.0f);
    EXPECT_EQ(values[3], 2.5f);
    EXPECT_EQ(values[4], 0.0f);
    EXPECT_TRUE(std::isnan(values[5]));
    EXPECT_EQ(values[6], 2048.0f);
    EXPECT_TRUE(is_mixed_object(2.5f));
    EXPECT_FALSE(is_mixed_object(2.9999998f));
}

TEST(ObjectIds, BitsOfFloatsAreRecognised) {
    std::vector<float> small{0, std::bit_cast<float>(3u), std::bit_cast<float>(17u), 0};
    EXPECT_EQ(object_storage(small), ObjectStorage::bits);
    label_objects(small, ObjectStorage::bits);
    EXPECT_EQ(small, (std::vector<float>{0, 3, 17, 0}));
    std::vector<float> hashes;  // few objects, many pixels of each
    for (int i = 0; i < 1000; ++i) hashes.push_back(std::bit_cast<float>(i % 3 == 0 ? 0x4b3a1f27u : 0x3f9d2b11u));
    EXPECT_EQ(object_storage(hashes), ObjectStorage::bits);
    label_objects(hashes, ObjectStorage::bits);
    EXPECT_EQ(hashes[0], object_label(0x4b3a1f27));
    std::vector<float> varied;  // hashes whose floats are tiny, huge, or whole by chance
    for (int i = 0; i < 300; ++i)
        varied.push_back(std::bit_cast<float>(i % 3 == 0 ? 0x024b1f27u : i % 3 == 1 ? 0x7a9d2b11u : 0x4f3a1f00u));
    EXPECT_EQ(object_storage(varied), ObjectStorage::bits);
    std::vector<float> shares;  // what filters leave of 3 at edges: small, and none alike
    for (int i = 1; i < 300; ++i) shares.push_back(i % 2 == 0 ? 3 : 3e-6f * static_cast<float>(i));
    EXPECT_EQ(object_storage(shares), ObjectStorage::single);
    std::vector<float> edges;  // averages of two objects, of which no two are alike
    for (int i = 1; i < 1000; ++i) edges.push_back(3 + 4 * static_cast<float>(i) / 1000);
    EXPECT_EQ(object_storage(edges), ObjectStorage::single);
}

}  // namespace
}  // namespace wrinkle::io
