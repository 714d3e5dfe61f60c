// Triplanar and decal references against the golden tables.
#include <gtest/gtest.h>

#include "tests/reference/decal.h"
#include "tests/reference/golden.h"
#include "tests/reference/triplanar.h"

namespace wrinkle::reference {
namespace {

constexpr real tolerance = 1e-12L;

TEST(Golden, Triplanar) {
    const GoldenTable table = golden("listing13_triplanar");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> g =
            triplanar_volume_gradient(table.vec(i, "w"), table.vec2(i, "dx"), table.vec2(i, "dy"), table.vec2(i, "dz"));
        const Vec<real> got = surface_gradient_from_volume(normalize(table.vec(i, "n")), g);
        EXPECT_LE(relative_error(got, table.vec(i, "want_sg")), tolerance) << table.label(i);
    }
}

TEST(Golden, TriplanarWeights) {
    const GoldenTable table = golden("listing14_triplanar_weights");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> w = triplanar_weights<real>(table.vec(i, "n"), table.number(i, "k"));
        EXPECT_TRUE(finite(w)) << table.label(i);
        const Vec<real> want = table.vec(i, "want_w");
        if (!finite(want)) continue;
        EXPECT_LE(relative_error(w, want), tolerance) << table.label(i);
    }
}

TEST(Golden, Decal) {
    const GoldenTable table = golden("listing15_decal");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> g = decal_volume_gradient(table.vec2(i, "d"), table.vec(i, "X"), table.vec(i, "Y"));
        const Vec<real> got = surface_gradient_from_volume(normalize(table.vec(i, "n")), g);
        EXPECT_LE(relative_error(got, table.vec(i, "want_sg")), tolerance) << table.label(i);
    }
}

TEST(DecalBox, WeightFallsFromOneInsideToZeroAtTheFaces) {
    using V = Vec<real>;
    EXPECT_EQ(decal_box_weight(V{0, 0.5L, -0.5L}, 0.5L), 1);
    EXPECT_EQ(decal_box_weight(V{0.75L, 0, 0}, 0.5L), 0.5L);
    EXPECT_EQ(decal_box_weight(V{0.75L, -0.75L, 0.75L}, 0.5L), 0.125L);
    EXPECT_EQ(decal_box_weight(V{1, 0, 0}, 0.5L), 0);
    EXPECT_EQ(decal_box_weight(V{1, 0, 0}, 0.0L), 1);
    EXPECT_EQ(decal_box_weight(V{0, 0, 1.01L}, 0.0L), 0);
}

TEST(DecalBox, AngleFadeIsLinearInTheCosineOrAStep) {
    EXPECT_EQ(decal_angle_fade(0.25L, 0.25L, 0.5L), 0);
    EXPECT_EQ(decal_angle_fade(0.375L, 0.25L, 0.5L), 0.5L);
    EXPECT_EQ(decal_angle_fade(0.9L, 0.25L, 0.5L), 1);
    EXPECT_EQ(decal_angle_fade(0.4L, 0.5L, 0.5L), 0);
    EXPECT_EQ(decal_angle_fade(0.6L, 0.5L, 0.5L), 1);
}

TEST(DecalBox, AxesAreMadeOrthonormal) {
    using V = Vec<real>;
    const DecalBox<real> box = decal_box(V{1, 2, 3}, V{2, 0, 0}, V{1, 3, 0}, V{0.5L, 1, 2});
    EXPECT_EQ(length(box.y - V{0, 1, 0}), 0);
    EXPECT_EQ(length(box.z - V{0, 0, 1}), 0);
    EXPECT_EQ(length(decal_coordinates(box, V{0.5L, 1, -2}) - V{1, 1, -1}), 0);
}

}  // namespace
}  // namespace wrinkle::reference
