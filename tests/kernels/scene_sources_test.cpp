// The kernel of every scene of data/scenes compiles in each form that a scene may ask for: whatever its own file says
// of areas and light, and with what other scenes ask.
#include <gtest/gtest.h>

#include "run/open_frame.h"
#include "run/pass_impl.h"
#include "tests/kernels/clang_complaints.h"
#include "wrinkle/scene.h"

namespace wrinkle::test {
namespace {

std::vector<std::string> data_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(WRINKLE_SOURCE_DIR "/data/scenes"))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

class EverySceneSource : public testing::TestWithParam<std::string> {};

TEST_P(EverySceneSource, Compiles) {
    if (!has_clang()) GTEST_SKIP() << "clang was not found by cmake";
    const Scene scene = load_scene(fmt::format("{}/data/scenes/{}.toml", WRINKLE_SOURCE_DIR, GetParam()));
    const Frame frame = describe_frame(scene);
    Scene relit = scene;
    relit.lighting.relight = Relight::ratio;
    relit.lighting.shadows = Shadows::read;
    if (relit.lighting.lights.empty()) relit.lighting.lights.resize(1);
    std::set<std::string> seen;
    const auto compile = [&](const Scene& own, const PlanOptions& options, const std::string& what) {
        const std::string source = plan_for(own, frame, options).source;
        if (!seen.insert(source).second) return;
        EXPECT_EQ(clang_complaints(source, "-cl-std=CL1.2 -DWR_LANES=8"), "") << what;
    };
    if (frame.planes.contains("beauty.r")) compile(relit, {}, "relit by ratio");
    for (const int taps : {scene.filter.taps, 1, 16})
        for (const bool roughness : {false, true})
            for (const bool mean : {false, true})
                for (const Precision precision : {Precision::standard, Precision::exact}) {
                    Scene own = scene;
                    own.filter = {.taps = taps, .light_mean = mean};
                    own.output.roughness = own.output.slope_covariance = own.output.layers = roughness;
                    compile(own, {.precision = {precision, std::vector(own.layers.size(), precision)}},
                            fmt::format("{} points, roughness {}, light by the mean {}, {}", taps, roughness, mean,
                                        precision_name(precision)));
                }
}

INSTANTIATE_TEST_SUITE_P(Data, EverySceneSource, testing::ValuesIn(data_scenes()),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace wrinkle::test
