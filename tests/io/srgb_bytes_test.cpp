#include "io/srgb_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wrinkle::io {
namespace {

TEST(SrgbBytes, AreTheCurveRounded) {
    for (float x = 0x1p-16f; x < 1; x = std::nextafter(x * 1.0001f, 2.0f))
        ASSERT_EQ(srgb_byte(x), static_cast<int>(srgb(x) * 255 + 0.5f)) << x;
}

TEST(SrgbBytes, StayWithinABytesRange) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    for (const float low : {0.0f, -1.0f, -inf, std::numeric_limits<float>::quiet_NaN(), 1e-40f})
        EXPECT_EQ(srgb_byte(low), 0) << low;
    for (const float high : {1.0f, 2.0f, inf}) EXPECT_EQ(srgb_byte(high), 255) << high;
}

}  // namespace
}  // namespace wrinkle::io
