// Height maps against other people's software: the normals that the Bump node of Blender Cycles makes from the same
// map, distance and UV (data/make/render_cycles_bump.py). wrinkle gets the unbumped passes of the same pixels and works
// as it does by default, with a bare UV pass, depth and mips.
//
// Cycles bends shading normals so that reflections stay above the surface: where the viewer's mirror direction R has
// n.R < 0.01, for every closure in 3.4. These pixels have another normal on purpose. They are left out, with a margin,
// and counted. The differences that remain are one-sided differences of UV at the torus's silhouette (nearly all of its
// last percent), and slopes that the Sobel operator and mips smooth, where Cycles uses the texture as it is.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using namespace std::string_literals;

constexpr double kept_reflection = 0.05;  // Cycles has 0.01; the margin is for normals that differ by some degrees

struct CyclesCase {
    const char* name;
    double median, p99;  ///< upper bounds of the differences, degrees
    double bump;         ///< lower bound of the median angle by which Cycles tilts normals, degrees
    double left_out;     ///< upper bound of the share of pixels that are left out
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
