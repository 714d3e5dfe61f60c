#include "tests/reference/uv_derivative.h"

#include <gtest/gtest.h>

namespace wrinkle::reference {
namespace {

using V = Vec<real>;
using V2 = Vec2<real>;
using Difference = std::optional<V2>;

const UvPixel<real> here{true, 3.0f, {0, 0, 1}, {0, 0, 0}, {0.5L, 0.5L}};
const V dp{0.1L, 0, 0};

UvPixel<real> right() { return {true, 3.0f, {0, 0, 1}, {0.1L, 0, 0}, {0.52L, 0.51L}}; }

TEST(UvDerivative, NeighbourOnTheSameSurfaceGivesTheDifference) {
    const Difference d = uv_difference(here, right(), dp);
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->x, 0.02L, 1e-18L);
    EXPECT_NEAR(d->y, 0.01L, 1e-18L);
}

TEST(UvDerivative, NoDifferenceAcrossABreak) {
    const auto usable = [](auto change) {
        UvPixel<real> j = right();
        change(j);
        return uv_difference(here, j, dp).has_value();
    };
    EXPECT_FALSE(usable([](auto& j) { j.valid = false; }));
    EXPECT_FALSE(usable([](auto& j) { j.object = 4.0f; }));
    EXPECT_FALSE(usable([](auto& j) { j.normal = normalize(V{2, 0, 1}); }));
    EXPECT_TRUE(usable([](auto& j) { j.position = {0.3L, 0, 0}; }));
    EXPECT_FALSE(usable([](auto& j) { j.position = {0.41L, 0, 0}; }));
    EXPECT_FALSE(usable([](auto& j) { j.uv.y = 0; }));
    EXPECT_FALSE(usable([](auto& j) { j.uv.x = std::nanl(""); }));
}

TEST(UvDerivative, MeanUnlessOneIsMoreThanTwiceTheOther) {
    const Difference a = V2{0.02L, 0}, b = V2{0.03L, 0}, far = V2{0.05L, 0};
    EXPECT_NEAR(combine_differences(a, b)->x, 0.025L, 1e-18L);
    EXPECT_EQ(combine_differences(a, far)->x, 0.02L);
    EXPECT_EQ(combine_differences(far, a)->x, 0.02L);
    EXPECT_EQ(combine_differences(Difference{}, a)->x, 0.02L);
    EXPECT_EQ(combine_differences(a, Difference{})->x, 0.02L);
    EXPECT_FALSE(combine_differences(Difference{}, Difference{}));
}

TEST(UvDerivative, LeastSquaresOfTheTangents) {
    const V dp_du{1, 2, 0.5L}, dp_dv{-0.3L, 1, 2};
    const Difference d = uv_derivative_from_tangents(dp_du * 0.25L - dp_dv * 0.75L + cross(dp_du, dp_dv), dp_du, dp_dv);
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->x, 0.25L, 1e-17L);
    EXPECT_NEAR(d->y, -0.75L, 1e-17L);
    EXPECT_FALSE(uv_derivative_from_tangents(dp, dp_du, V{}));
}

}  // namespace
}  // namespace wrinkle::reference
