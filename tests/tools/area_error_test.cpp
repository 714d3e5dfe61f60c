#include "tools/area_error.h"

#include "tests/run/area_truth.h"
#include "tests/tools/ground_scene.h"

namespace wrinkle::test {
namespace {

AreaOptions options() {
    AreaOptions options;
    options.taps = {1, 16};
    options.sample = 150;
    options.repeat = 1;
    if (const char* device = std::getenv("WRINKLE_TEST_DEVICE")) options.device = device;
    return options;
}

TEST(AreaError, IsWhatBruteForceSays) {
    const TempFolder folder;
    const Layer cobbled = layer_of(HeightMapLayer{{.file = cobbles}, planar}, 0.3);
    const AreaErrors errors = measure_area(on_ground(folder, cobbled), options());

    std::vector<double> tilts;
    for (const Area& area : brute_force(scene_of(cobbled)))
        if (area.whole) tilts.push_back(angle_degrees(normal_of(area.gradient), V{0, 0, 1}));
    const double tilt = Spread(tilts).median;
    EXPECT_NEAR(errors.unbumped.median, tilt, 0.25 * tilt) << "150 pixels, drawn, of " << tilts.size();
    ASSERT_EQ(errors.taps.size(), 2u);
    EXPECT_EQ(errors.unbumped.samples, 150u);
    EXPECT_LT(errors.taps[1].degrees.median, 2);  // tests/run/area_test.cpp's bound
    EXPECT_GT(errors.taps[0].degrees.median, 2 * errors.taps[1].degrees.median);
    EXPECT_GT(errors.taps[0].ns, 0);
}

TEST(AreaError, IsNoneWhereNothingVaries) {
    const TempFolder folder;
    Scene scene = on_ground(folder, layer_of(ConstantLayer{.gradient = {0.3, -0.2, 0}}, 1));
    AreaOptions few = options();
    few.sample = 20;
    const AreaErrors errors = measure_area(scene, few);
    EXPECT_LT(errors.taps[1].degrees.max, 1e-4);
    EXPECT_GT(errors.unbumped.median, 10);
    const AreaErrors again = measure_area(scene, few);
    EXPECT_EQ(again.unbumped.median, errors.unbumped.median) << "the same seed draws the same pixels";
}

TEST(AreaError, TakesFramesWithMorePixelsThanTheirPicture) {
    const TempFolder folder;
    Scene scene = on_ground(folder, layer_of(ConstantLayer{.gradient = {0.3, -0.2, 0}}, 1));
    write_exr(folder / "ground.exr", 24, 18, {"N.X", "N.Y", "N.Z", "Z"}, [](int c, int, int) {
        return c == 2 ? 1.0f : c == 3 ? 10.0f : 0.0f;
    });
    write_exr(folder / "beauty.exr", 8, 6, {"R", "G", "B"}, [](int, int, int) { return 0.5f; });
    scene.gbuffer.beauty_file = folder / "beauty.exr";
    AreaOptions few = options();
    few.sample = 20;
    EXPECT_EQ(measure_area(scene, few).unbumped.samples, 20u);
}

TEST(AreaError, NeedsASurface) {
    const TempFolder folder;
    Scene scene = on_ground(folder, layer_of(ConstantLayer{.gradient = {0.3, -0.2, 0}}, 1));
    write_exr(folder / "ground.exr", 24, 16, {"N.X", "N.Y", "N.Z", "Z"},
              [](int c, int, int) { return c == 3 ? 1e10f : 0; });
    expect_mentions(error_of([&] { measure_area(scene, options()); }), {"ground.exr", "none of"});
}

}  // namespace
}  // namespace wrinkle::test
