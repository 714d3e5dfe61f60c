#include "resources/lost_slopes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "resources/texel_wrap.h"

namespace wrinkle {
namespace {

/// Channel c of a bilinear sample at (x, y), texels: texel 0 lies around 0.
double sampled(const Image& image, double x, double y, int c, Wrap wrap) {
    const int left = static_cast<int>(std::floor(x)), low = static_cast<int>(std::floor(y));
    double sum = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            sum += (i == 0 ? 1 - (x - left) : x - left) * (j == 0 ? 1 - (y - low) : y - low) *
                   image.at(wrapped(left + i, image.width, wrap), wrapped(low + j, image.height, wrap), c);
    return sum;
}

Image random_slopes(int width, int height) {
    Image slopes{width, height, 2, {}};
    std::mt19937 random(5);
    for (int i = 0; i < 2 * width * height; ++i)
        slopes.texels.push_back(static_cast<float>(random()) / 2147483648.0F - 1 + 3);
    return slopes;
}

TEST(LostSlopes, AreTheMeansOverEachTexelOfWhatSamplesAverage) {
    constexpr int kSteps = 64;
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp})
        for (const auto& [width, height] : {std::pair{5, 3}, std::pair{2, 1}, std::pair{1, 4}}) {
            Image level = with_products(random_slopes(width, height));
            for (std::size_t i = 2; i < level.texels.size(); i += 5) level.texels[i] += 0.25F;  // finer than the level
            const Image lost = lost_slopes(level, wrap);
            ASSERT_EQ(lost.channels, 3);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    double want[3] = {0, 0, 0};
                    for (int j = 0; j < kSteps; ++j)
                        for (int i = 0; i < kSteps; ++i) {
                            const double u = x - 0.5 + (i + 0.5) / kSteps, v = y - 0.5 + (j + 0.5) / kSteps;
                            const double s = sampled(level, u, v, 0, wrap), t = sampled(level, u, v, 1, wrap);
                            const double products[] = {s * s, s * t, t * t};
                            for (int k = 0; k < 3; ++k)
                                want[k] += (sampled(level, u, v, 2 + k, wrap) - products[k]) / (kSteps * kSteps);
                        }
                    for (int k = 0; k < 3; ++k)
                        EXPECT_NEAR(lost.at(x, y, k), want[k], 2e-4) << x << " " << y << " " << k;
                }
        }
}

TEST(LostSlopes, OfALevelWithoutAnyAreNone) {
    Image flat{4, 4, 2, {}};
    for (int i = 0; i < 16; ++i) flat.texels.insert(flat.texels.end(), {0.1F, -7.3F});
    for (const float part : lost_slopes(with_products(flat), Wrap::repeat).texels) EXPECT_NEAR(part, 0, 1e-5F);
}

/// A file's own products may be smaller than its slopes allow.
TEST(LostSlopes, AreACovarianceWhateverProductsAFileBrings) {
    Image level = with_products(random_slopes(6, 6));
    for (std::size_t i = 2; i < level.texels.size(); i += 5) level.texels[i] = 0, level.texels[i + 1] = 99;
    const Image lost = lost_slopes(level, Wrap::repeat);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x) {
            EXPECT_EQ(lost.at(x, y, 0), 0);
            EXPECT_EQ(lost.at(x, y, 1), 0);
            EXPECT_GE(lost.at(x, y, 2), 0);
        }
}

}  // namespace
}  // namespace wrinkle
