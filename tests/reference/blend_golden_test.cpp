// Blends of tangent-space normals against their golden table.
#include <gtest/gtest.h>

#include "tests/reference/blend.h"
#include "tests/reference/golden.h"

namespace wrinkle::reference {
namespace {

TEST(Golden, Blends) {
    const GoldenTable table = golden("blend_tspace_normals");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> a = table.vec(i, "a"), b = table.vec(i, "b");
        const auto expect = [&](Vec<real> got, const char* column, real tolerance = 1e-12L) {
            EXPECT_LE(relative_error(got, table.vec(i, column)), tolerance) << column << ", " << table.label(i);
        };
        expect(blend_rnm(a, b), "want_rnm");
        expect(normalize(blend_rnm(a, b)), "want_rnmN");
        expect(blend_partial_derivative(a, b), "want_pd");
        expect(blend_whiteout(a, b), "want_whiteout");
        expect(blend_udn(a, b), "want_udn");
        expect(reorient(table.vec(i, "vtx"), b, a), "want_rnmWS");  // in the table b is the base and a the detail
    }
}

TEST(Blend, RnmIsAReorientationAboutZ) {
    const Vec<real> a = normalize(Vec<real>{0.3L, -0.5L, 0.7L}), b = normalize(Vec<real>{-0.2L, 0.1L, 0.9L});
    EXPECT_LE(relative_error(reorient(Vec<real>{0, 0, 1}, a, b), blend_rnm(a, b)), 1e-17L);
}

/// How a second normal map combines with the first one must not depend on their unwraps. When both have the same,
/// combining gradients must give what blending tangent-space normals gives.
TEST(Blend, OfGradientsInOneFrameIsThatOfTangentNormals) {
    const Vec<real> n{0, 0, 1}, a = normalize(Vec<real>{0.3L, -0.5L, 0.7L}),
                                b = normalize(Vec<real>{-0.2L, 0.1L, 0.9L});
    const auto gradient = [](Vec<real> m) { return Vec<real>{-m.x / m.z, -m.y / m.z, 0}; };
    const auto combined = [&](Blending how) { return resolve(n, combine_gradients(how, n, gradient(a), gradient(b))); };
    EXPECT_LE(angle_degrees(combined(Blending::whiteout), blend_whiteout(a, b)), 1e-15L);
    EXPECT_LE(angle_degrees(combined(Blending::udn), blend_udn(a, b)), 1e-15L);
    EXPECT_LE(angle_degrees(combined(Blending::linear), blend_linear(a, b)), 1e-15L);
    EXPECT_LE(angle_degrees(combined(Blending::rnm), blend_rnm(a, b)), 1e-15L);
}

}  // namespace
}  // namespace wrinkle::reference
