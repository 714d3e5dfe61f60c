#include "tools/metal_pictures.h"

#include <cmath>

#include "tests/tools/ground_scene.h"

namespace wrinkle::test {
namespace {

/// Writes a frame with a metal ball of so many pixels' radius in its middle, which shows `radiance` everywhere.
void write_ball(const fs::path& file, double radius, float radiance) {
    write_exr(file, 96, 72, {"N.X", "N.Y", "N.Z", "Z", "C.R", "C.G", "C.B", "metal", "id"}, [=](int c, int x, int y) {
        const double right = (x - 47.5) / radius, up = (35.5 - y) / radius, square = right * right + up * up;
        const bool ball = square < 1;
        if (c == 0) return ball ? static_cast<float>(right) : 0.0f;
        if (c == 1) return ball ? static_cast<float>(up) : 0.0f;
        if (c == 2) return ball ? static_cast<float>(std::sqrt(1 - square)) : 1.0f;
        if (c == 3) return 10.0f;
        if (c < 7) return radiance;
        return ball ? 1.0f : 0.0f;
    });
}

class MetalsOfAFrame : public testing::Test {
protected:
    MetalPictures of(double radius, float radiance, const MetalPictures& before = {}) {
        write_ball(folder / "ground.exr", radius, radiance);
        return metals_of_frame(scene, 0, before);
    }

    const TempFolder folder;
    Scene scene = [this] {
        Scene made = on_ground(folder, layer_of(ConstantLayer{.gradient = {0.3, 0, 0}}, 1));
        made.lighting.relight = Relight::ratio;
        made.gbuffer.roles["beauty"] = "C", made.gbuffer.roles["metallic"] = "metal",
        made.gbuffer.roles["object"] = "id";
        return made;
    }();
};

TEST_F(MetalsOfAFrame, AreReadOffWhatIsLargeAndRound) {
    ASSERT_TRUE(wants_metals(scene));
    const MetalPictures metals = of(30, 0.5f);
    ASSERT_TRUE(metals);
    ASSERT_EQ(metals->size(), 1u);
    EXPECT_EQ(metals->front().object, 1);
    for (const Vec3& colour : metals->front().seen)
        for (const double channel : colour) EXPECT_NEAR(channel, 0.5, 1e-6);
    const MetalPictures small = of(5, 0.5f);
    EXPECT_TRUE(!small || small->empty()) << "80 pixels tell too little";
}

// An object may be hidden, leave the frame or become small: the frame before then tells what it mirrors.
TEST_F(MetalsOfAFrame, AreThoseOfTheFrameBeforeWhereThisOneShowsTooLittle) {
    const MetalPictures before = of(30, 0.5f);
    ASSERT_TRUE(before);
    for (const double radius : {0.1, 1.5, 2.5, 5.0}) {
        const MetalPictures now = of(radius, 0.25f, before);
        ASSERT_TRUE(now) << radius;
        ASSERT_EQ(now->size(), 1u) << radius;
        EXPECT_EQ(now->front().seen, before->front().seen) << radius;
    }
    EXPECT_NEAR(of(20, 0.25f, before)->front().seen.at(40)[0], 0.25, 1e-6) << "large enough, it tells itself";
}

}  // namespace
}  // namespace wrinkle::test
