// Height maps against other people's software: the normals that Blender Cycles' Bump node made of the same map,
// distance and UV (data/make/render_cycles_bump.py), from the unbumped passes of the same pixels and by the default
// path: bare UV, depth, mips.
//
// Cycles keeps reflections above the surface: it bends a shading normal whose mirror direction R of the viewer dips
// below n.R = 0.01, for every closure in 3.4. Those pixels hold another normal on purpose and are left out, with a
// margin, and counted. What remains: one-sided differences of UV at the silhouettes of the torus (nearly all of its
// last percent), and slopes that the Sobel operator and mips smooth where Cycles takes the texture's own.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using namespace std::string_literals;

constexpr double kept_reflection = 0.05;  // Cycles': 0.01; the normals differ by degrees

struct CyclesCase {
    const char* name;
    double median, p99;  ///< degrees, at most
    double bump;         ///< degrees between the base normal and Cycles' bumped one, median, at least
    double left_out;     ///< share of the pixels, at most
};

class CyclesBump : public testing::TestWithParam<CyclesCase> {};

TEST_P(CyclesBump, IsWhatHeightMapsMake) {
    const CyclesCase& expected = GetParam();
    const HostFrame frame = data_frame(expected.name);
    const Pixels got = evaluate_on(frame, data_scene(expected.name));
    const reference::CameraRays<double> rays(frame.frame.camera, frame.frame.size);
    std::vector<double> errors, bumps;
    std::size_t covered = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (!(frame.pixels.at("depth")[i] < 1e9f)) continue;
        ++covered;
        const V base = normalize(vec_at(frame.pixels, "normal", i)), bumped = vec_at(got, "normal", i);
        const auto cycles_part = [&](const char* axis) {
            return static_cast<double>(frame.pixels.at("channel:ViewLayer.BumpedNormal."s + axis)[i]);
        };
        const V cycles = normalize(V{cycles_part("X"), cycles_part("Y"), cycles_part("Z")});
        const double x = static_cast<double>(i % frame.frame.size.width) + 0.5;
        const double y = static_cast<double>(i / frame.frame.size.width) + 0.5;
        const V viewer = -rays.at_distance(x, y, 1);
        const V mirrored = bumped * (2 * dot(bumped, viewer)) - viewer;
        if (dot(base, mirrored) < kept_reflection) continue;
        errors.push_back(angle_degrees(bumped, cycles));
        bumps.push_back(angle_degrees(base, cycles));
    }
    const double left_out = 1 - static_cast<double>(errors.size()) / static_cast<double>(covered);
    print(expected.name + ": Cycles' bump"s, Spread(bumps), "degrees");
    fmt::print("{:<34} {:.2f} % of the pixels\n", expected.name + ": left out"s, 100 * left_out);
    expect_within(expected.name + ": difference"s, Spread(errors), {expected.median, expected.p99, 45}, "degrees");
    EXPECT_GE(Spread(bumps).median, expected.bump);
    EXPECT_LE(left_out, expected.left_out);
}

INSTANTIATE_TEST_SUITE_P(Frames, CyclesBump,
                         testing::Values(CyclesCase{"cycles_torus", 0.2, 2.0, 5, 0.02},
                                         CyclesCase{"cycles_ground", 0.25, 1.0, 5, 0.02}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace wrinkle::test
