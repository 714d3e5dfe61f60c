// The fused kernel of every scene of data/scenes, on a rendered frame, compared with the double-precision evaluator of
// the references.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

struct SceneCase {
    std::string name;
    Bounds degrees;      ///< bounds of the normals' errors
    Bounds relative;     ///< bounds of the errors of lit colours, relative to the colour or at least to 0.01
    bool jumps = false;  ///< gradients jump somewhere, and pixels near that are left out
};

/// Whether a pixel's true normal turns by more than half a degree when its point moves by a 50,000th of its distance.
/// There the gradient jumps, or nearly does, and rounding decides on which side of the jump the pixel lies.
std::vector<bool> near_jumps(const HostFrame& frame, const Scene& scene, const Truth& truth) {
    std::vector<bool> near(frame.count());
    for (const float nearer : {1 - 2e-5f, 1 + 2e-5f}) {
        HostFrame moved = frame;
        for (float& depth : moved.pixels.at("depth")) depth *= nearer;
        const Truth there(moved, scene);
        for (std::size_t i = 0; i < near.size(); ++i)
            near[i] = near[i] || angle_degrees(truth.pixels[i].normal, there.pixels[i].normal) > 0.5;
    }
    return near;
}

class DataScene : public testing::TestWithParam<SceneCase> {};

TEST_P(DataScene, AgreesWithTheReference) {
    const SceneCase& expected = GetParam();
    const HostFrame frame = small_frame();
    const Scene scene = data_scene(expected.name);
    const Truth truth(frame, scene);
    const Pixels got = evaluate_on(frame, scene);
    const auto left_out = expected.jumps ? near_jumps(frame, scene, truth) : std::vector<bool>(frame.count());
    EXPECT_LT(std::ranges::count(left_out, true), static_cast<long>(frame.count() / 50));
    expect_within(expected.name + ": normal", normal_error(got, truth, left_out), expected.degrees, "degrees");
    EXPECT_EQ(marked_differences(got, truth), 0u);
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (left_out[i]) continue;
        const V want = truth.lit[i], gap = vec_at(got, "lit", i) - want;
        errors.push_back(length(gap) / std::max(length(want), 0.01));
    }
    expect_within(expected.name + ": lit", Spread(std::move(errors)), expected.relative, "relative");
}

// Bounds are about three times what was measured with PoCL 3.1 at 16 lanes. They are larger for heights, whose slopes
// are stored as floats, and where 512 texels magnify the rounding of positions; for noise with eight octaves; and for
// combine, whose planar coordinates have no frame where the surface is perpendicular to their plane.
constexpr Bounds light{2.5e-7, 1e-5, 1e-4};
const std::vector<SceneCase> scene_cases{SceneCase{"combine", {6e-6, 2e-4, 0.1}, {2e-7, 1e-5, 1e-3}},
                                         SceneCase{"comparisons", {1.2e-5, 6e-3, 2e-2}, {2e-7, 1e-4, 5e-4}},
                                         SceneCase{"constant", {3e-6, 1e-5, 2e-5}, {2e-7, 5e-7, 1e-6}},
                                         SceneCase{"courtyard", {2.5e-5, 8e-4, 2.5e-3}, light},
                                         SceneCase{"decals", {3e-7, 3e-4, 1e-3}, light},
                                         SceneCase{"decal_table", {3e-7, 5e-4, 1.2e-3}, light},
                                         SceneCase{"derivative_map", {1.2e-5, 4e-4, 1e-3}, light},
                                         SceneCase{"gradient", {3e-6, 1e-5, 2e-5}, {2e-7, 5e-7, 1e-6}},
                                         SceneCase{"height_channel", {3e-7, 1e-5, 2e-5}, {2e-7, 5e-7, 1e-6}},
                                         SceneCase{"height_map", {4e-6, 5e-4, 1.6e-3}, light},
                                         SceneCase{"kernel", {3e-7, 6e-4, 2e-3}, light},
                                         SceneCase{"lighting", {6e-5, 3e-4, 1e-3}, {3e-7, 1e-5, 1e-4}},
                                         SceneCase{"noise", {2e-4, 2e-3, 4e-3}, {1e-6, 3e-5, 1.5e-4}},
                                         SceneCase{"noise_family", {2.2e-4, 1.5e-2, 4e-2}, {3e-7, 3e-4, 1e-3}, true},
                                         SceneCase{"normal_map", {3e-7, 5e-5, 2e-4}, light},
                                         SceneCase{"object_normal", {3e-6, 2e-4, 1e-3}, light},
                                         SceneCase{"parallax", {4e-6, 9e-4, 4.5e-3}, {2e-7, 1.6e-5, 1e-4}},
                                         SceneCase{"resolve", {7e-5, 8e-4, 2e-3}, light},
                                         SceneCase{"triplanar", {3e-7, 4e-4, 1.5e-3}, light},
                                         SceneCase{"triplanar_object", {3e-7, 8e-4, 2.5e-3}, light},
                                         SceneCase{"triplanar_planes", {3e-7, 8e-4, 5e-3}, light, true},
                                         SceneCase{"volume", {3e-7, 2e-3, 6e-3}, light}};

INSTANTIATE_TEST_SUITE_P(Scenes, DataScene, testing::ValuesIn(scene_cases),
                         [](const auto& info) { return info.param.name; });

// Those of frames that Cycles bumped are compared with Cycles (cycles_test.cpp).
TEST(DataScenes, AreAllCompared) {
    for (const auto& entry : fs::directory_iterator(data_folder / "scenes")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".toml" || name.starts_with("cycles_")) continue;
        EXPECT_TRUE(std::ranges::any_of(scene_cases, [&](const SceneCase& known) { return known.name == name; }))
            << name << ": give it bounds";
    }
}

}  // namespace
}  // namespace wrinkle::test
