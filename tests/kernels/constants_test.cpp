// constants.clh: the thresholds, tested by the functions that use them.
#include <gtest/gtest.h>

#include "resources/frame_constants.h"
#include "tests/kernels/kernel_function.h"
#include "tests/reference/relit.h"

namespace wrinkle::test {
namespace {

/// Evaluates expressions of a column v.
Results over(const std::vector<float>& v, const std::vector<std::string>& outputs, const std::string& body = {},
             const ColumnData& data = {}) {
    return run_kernel({body, outputs}, {{"v", v}}, {lanes_to_try({8, 1}).front(), false}, data);
}

using Numbers = std::vector<double>;

TEST(Constants, BackgroundStartsAtItsDepth) {
    const float last = std::nextafter(1e9f, 0.0f);
    EXPECT_EQ(over({last, 1e9f, 1e10f}, {"truth(wr_valid_depth(wr_load_floats(in_v, at)))"})[0], (Numbers{1, 0, 0}));
}

/// For rays within the tangent plane and beyond it, derivatives are finite, and continuous on either side.
TEST(Constants, LeastCosineKeepsScreenDerivativesFinite) {
    wr_camera frame{};
    frame.d0[2] = -1, frame.dx[0] = 0.001, frame.dy[1] = -0.001;
    frame.dx_cross_d0[1] = 0.001, frame.dx_cross_dy[2] = -1e-6;
    frame.dy_cross_d0[0] = 0.001, frame.dy_cross_dx[2] = 1e-6;
    frame.c0[0] = 0.001, frame.c1[1] = -0.001, frame.c3[2] = -1, frame.w[2] = 1;
    ColumnData data;
    data.constants.assign(&frame.width, &frame.width + sizeof frame / sizeof(double));
    const std::string body =
        "constant const wr_camera *camera = (constant const wr_camera *)constants;\n"
        "wr_vec3 n = wr_v3((wr_real)(1), (wr_real)(0), v), p = wr_v3((wr_real)(0), (wr_real)(0), (wr_real)(-5)), a, b, "
        "c, d;\n"
        "wr_screen_derivatives(camera, n, p, (wr_real)(1), (wr_real)(0), (wr_real)(0), &a, &b);\n"
        "wr_screen_derivatives_general(camera, n, p, (wr_real)(0), (wr_real)(0), &c, &d);";
    const Results r =
        over({0, -0.0f, 1e-30f, -1e-30f, 1e-8f, 1e-45f},
             {"a.x", "a.y", "a.z", "b.x", "b.y", "b.z", "c.x", "c.y", "c.z", "d.x", "d.y", "d.z"}, body, data);
    for (const auto& column : r)
        for (const double value : column) EXPECT_TRUE(std::isfinite(value));
}

TEST(Constants, LargestSlopeOfATangentNormal) {
    const Results r = over({0, 1e-30f, 1.0f / 256, 1.0f / 128, 1.0f / 64}, {"s.x", "s.y"},
                           "wr_vec2 s = wr_tangent_normal_slope(wr_v3((wr_real)(-1), (wr_real)(1), v));");
    EXPECT_EQ(r[0], (Numbers{128, 128, 128, 128, 64}));
    EXPECT_EQ(r[1], (Numbers{-128, -128, -128, -128, -64}));
}

TEST(Constants, TriplanarPlanesUnderTheBiasHaveNoWeight) {
    const Results r = over({0, 0.1f, 0.2f, 0.21f}, {"truth(w.x > 0)", "truth(w.z > 0)"},
                           "wr_vec3 w = wr_triplanar_weights(wr_v3(v, (wr_real)(0), (wr_real)(0.97f)), 3);");
    EXPECT_EQ(r[0], (Numbers{0, 0, 0, 1}));
    EXPECT_EQ(r[1], (Numbers{1, 1, 1, 1}));
}

TEST(Constants, OctavesFadeOutByTheirNoise) {
    const auto weight = [](const std::string& basis) {
        return over({0, 1, 9}, {"wr_octave_weight(wr_noise_mean((wr_noise){.basis = " + basis + "}), v)"})[0];
    };
    EXPECT_EQ(weight("WR_SIMPLEX"), (Numbers{1, 0, 0}));
    EXPECT_EQ(weight("WR_WORLEY + WR_F1"), (Numbers{1, 0.25, 0}));
}

TEST(Constants, RoughnessHasAFloorAndTheRatioABias) {
    const std::string body =
        "constant const wr_lighting *lighting = (constant const wr_lighting *)constants;\n"
        "constant const wr_light *lights = (constant const wr_light *)(lighting + 1);\n"
        "wr_vec3 up = wr_v3((wr_real)(0), (wr_real)(0), (wr_real)(1));\n"
        "wr_vec3 lit = wr_light_surface(wr_zero3(), up, up, up, wr_zero3(), v, lighting, lights);";
    wr_lighting lighting{};
    lighting.lights = 1, lighting.f0 = 1;
    wr_light sun{};
    sun.color[0] = sun.to_light[2] = 1;
    ColumnData data;
    data.constants.assign(lighting.sky, lighting.sky + sizeof lighting / sizeof(double));
    data.constants.insert(data.constants.end(), &sun.kind, &sun.kind + sizeof sun / sizeof(double));
    const Results r = over({0, 0.03f, 0.5f}, {"lit.x", "wr_relight_ratio(v * 0, v * 0, 4)"}, body, data);
    EXPECT_EQ(r[0][0], r[0][1]);
    EXPECT_GT(r[0][1], r[0][2]);
    EXPECT_EQ(r[1], (Numbers{1, 1, 1}));
}

}  // namespace
}  // namespace wrinkle::test
