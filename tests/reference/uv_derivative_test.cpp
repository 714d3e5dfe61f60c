#include "tests/reference/uv_derivative.h"

#include <gtest/gtest.h>

namespace wrinkle::reference {
namespace {

using V = Vec<real>;
using V2 = Vec2<real>;
using Change = UvChange<real>;
using Difference = std::optional<Change>;

const UvPixel<real> here{true, 3.0f, {0, 0, 1}, {0, 0, 0}, {0.5L, 0.5L}};
const V dp{0.1L, 0, 0};

UvPixel<real> right() { return {true, 3.0f, {0, 0, 1}, {0.1L, 0, 0}, {0.52L, 0.51L}}; }

TEST(UvDerivative, NeighbourOnTheSameSurfaceGivesTheDifference) {
    const Difference d = uv_differences(here, {}, right(), dp).first;
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->uv.x, 0.02L, 1e-18L);
    EXPECT_NEAR(d->uv.y, 0.01L, 1e-18L);
    EXPECT_EQ(d->step.x, 0.1L);
}

TEST(UvDerivative, NoDifferenceAcrossABreak) {
    const auto usable = [](auto change) {
        UvPixel<real> j = right();
        change(j);
        return uv_differences(here, {}, j, dp).first.has_value();
    };
    EXPECT_FALSE(usable([](auto& j) { j.valid = false; }));
    EXPECT_FALSE(usable([](auto& j) { j.object = 4.0f; }));
    EXPECT_FALSE(usable([](auto& j) { j.normal = normalize(V{2, 0, 1}); }));
    EXPECT_TRUE(usable([](auto& j) { j.position = {0.3L, 0, 0}; }));
    EXPECT_FALSE(usable([](auto& j) { j.position = {0.41L, 0, 0}; }));
    EXPECT_FALSE(usable([](auto& j) { j.uv.y = 0; }));
    EXPECT_FALSE(usable([](auto& j) { j.uv.x = std::nanl(""); }));
}

TEST(UvDerivative, LongStepIsNoSeamWhereTheOtherIsAsLong) {
    UvPixel<real> after = right(), before = right();
    after.uv.x = here.uv.x + 0.7L, before.uv.x = here.uv.x - 0.9L, before.position = {-0.1L, 0, 0};
    EXPECT_TRUE(uv_differences(here, before, after, dp).first && uv_differences(here, before, after, dp).second);
    before.uv.x = here.uv.x - 0.1L;
    EXPECT_FALSE(uv_differences(here, before, after, dp).first);
    EXPECT_TRUE(uv_differences(here, before, after, dp).second);
}

TEST(UvDerivative, MeanUnlessOneIsMoreThanTwiceTheOther) {
    const Difference a = Change{{0.02L, 0}, {1, 0, 0}}, b = Change{{0.03L, 0}, {3, 0, 0}}, far = Change{{0.05L, 0}, {}};
    EXPECT_NEAR(combine_differences(a, b)->uv.x, 0.025L, 1e-18L);
    EXPECT_EQ(combine_differences(a, b)->step.x, 2);
    EXPECT_EQ(combine_differences(a, far)->uv.x, 0.02L);
    EXPECT_EQ(combine_differences(far, a)->uv.x, 0.02L);
    const Difference mirrored = Change{{-0.03L, 0}, {3, 0, 0}}, none = Change{{0, 0}, {3, 0, 0}};
    EXPECT_EQ(combine_differences(a, mirrored)->uv.x, -0.03L);
    EXPECT_EQ(combine_differences(none, a)->uv.x, 0.02L);
    EXPECT_EQ(combine_differences(none, none)->uv.x, 0);
    EXPECT_EQ(combine_differences(Difference{}, a)->uv.x, 0.02L);
    EXPECT_EQ(combine_differences(a, Difference{})->uv.x, 0.02L);
    EXPECT_FALSE(combine_differences(Difference{}, Difference{}));
}

TEST(UvDerivative, ChangesAlongAnyTwoStepsGiveTheGradientOfALinearMap) {
    const V dp_dx{0.1L, 0.02L, 0}, dp_dy{-0.03L, 0.2L, 0};
    const auto map = [](V p) { return V2{3 * p.x - p.y, 0.5L * p.x + 2 * p.y}; };  // of points of the plane
    // Steps leave the plane, and must be projected.
    const auto change = [&](V step) { return Change{map(step), step + V{0, 0, 0.7L}}; };
    const auto [dx, dy] = uv_derivatives(change({0.06L, 0.01L, 0}), change({0.01L, 0.08L, 0}), dp_dx, dp_dy);
    EXPECT_NEAR(dx.x, map(dp_dx).x, 1e-17L);
    EXPECT_NEAR(dx.y, map(dp_dx).y, 1e-17L);
    EXPECT_NEAR(dy.x, map(dp_dy).x, 1e-17L);
    EXPECT_NEAR(dy.y, map(dp_dy).y, 1e-17L);
    const Change x = change({0.06L, 0.01L, 0});
    EXPECT_EQ(uv_derivatives(x, x * real{2}, dp_dx, dp_dy).first.x, x.uv.x) << "parallel steps";
}

TEST(UvDerivative, LeastSquaresOfTheTangents) {
    const V dp_du{1, 2, 0.5L}, dp_dv{-0.3L, 1, 2};
    const std::optional<V2> d =
        uv_derivative_from_tangents(dp_du * 0.25L - dp_dv * 0.75L + cross(dp_du, dp_dv), dp_du, dp_dv);
    ASSERT_TRUE(d);
    EXPECT_NEAR(d->x, 0.25L, 1e-17L);
    EXPECT_NEAR(d->y, -0.75L, 1e-17L);
    EXPECT_FALSE(uv_derivative_from_tangents(dp, dp_du, V{}));
}

}  // namespace
}  // namespace wrinkle::reference
