#include "tools/taps_choice.h"

#include "tests/tools/ground_scene.h"
#include "tools/render.h"

namespace wrinkle::test {
namespace {

std::string test_device_name() {
    const char* device = std::getenv("WRINKLE_TEST_DEVICE");
    return device ? device : "";
}

class TapsOfABudget : public testing::Test {
protected:
    TapsOfABudget() {
        scene.budget.sample = 60;
        scene.output.png = 0;
    }
    RenderReport rendered(double degrees) {
        scene.budget.max_area_error = degrees;
        RenderOptions options;
        options.directory = folder / "out", options.device = test_device_name();
        return render(scene, options);
    }

    const TempFolder folder;
    Scene scene = on_ground(folder, layer_of(HeightMapLayer{{.file = cobbles}, planar}, 0.3));
};

TEST_F(TapsOfABudget, AreTheFewestThatKeepIt) {
    const RenderReport loose = rendered(179), tight = rendered(12);
    ASSERT_TRUE(loose.taps && tight.taps);
    EXPECT_EQ(loose.taps->taps, 1);
    EXPECT_GT(tight.taps->taps, 1);
    EXPECT_LE(tight.taps->measured.p99, 12);
    EXPECT_GT(loose.taps->measured.p99, tight.taps->measured.p99);
    EXPECT_EQ(tight.taps->most, 16);
}

TEST_F(TapsOfABudget, AreToldWhereNoneKeepIt) {
    try {
        rendered(1e-3);
        ADD_FAILURE() << "nothing was refused";
    } catch (const Error& error) {
        expect_mentions(error.what(), {"max_area_error = 0.001 degrees cannot be kept: with 16 taps",
                                       "60 sampled pixels", "64 at most", "Nothing was written"});
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out/normal.exr"));
}

}  // namespace
}  // namespace wrinkle::test
