// Planes with some numbers that are not finite: what is written there instead, and that these pixels are marked.
#include <cmath>
#include <limits>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

HostFrame plane() {
    const Camera camera = reference::test_camera();
    return {reference::plane_frame(camera, {37, 5}, normalize(V{0.1, -0.2, 1})), camera};
}

Scene tilted() {
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.output.marked = true;
    return scene;
}

TEST(Holes, InThePictureAreBlackWhereItIsLitAnew) {
    HostFrame frame = plane();
    for (const char* name : {"beauty.r", "beauty.g", "beauty.b"}) frame.add(name, 0.5f);
    const std::size_t holes[] = {3, 40, 41, 100};
    frame.pixels["beauty.r"][holes[0]] = nan;
    frame.pixels["beauty.g"][holes[1]] = inf;
    frame.pixels["beauty.b"][holes[2]] = -inf;
    frame.pixels["beauty.b"][holes[3]] = nan;
    Scene scene = tilted();
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{}};
    const Pixels got = evaluate_on(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const bool hole = std::ranges::find(holes, i) != std::end(holes);
        EXPECT_EQ(got.at("marked")[i], hole ? 16 : 0) << i;
        for (const char color : {'r', 'g', 'b'}) {
            const float lit = got.at(std::string("lit.") + color)[i];
            EXPECT_TRUE(std::isfinite(lit)) << i;
            EXPECT_TRUE(hole || lit > 0) << i;
        }
    }
}

TEST(Holes, InAMaskAreNotBumpedInvertedOrNot) {
    HostFrame frame = plane();
    std::vector<float>& dust = frame.add("channel:dust");
    for (std::size_t i = 0; i < dust.size(); ++i) dust[i] = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : nan;
    for (const bool invert : {false, true}) {
        Scene scene = tilted();
        scene.layers[0].mask.channel = "dust";
        scene.layers[0].mask.invert = invert;
        const Pixels got = evaluate_on(frame, scene);
        for (std::size_t i = 0; i < frame.count(); ++i) {
            const bool bumped = got.at("normal.x")[i] != frame.pixels["normal.x"][i];
            EXPECT_EQ(bumped, dust[i] == (invert ? 0 : 1)) << i << ": " << dust[i];
        }
    }
}

}  // namespace
}  // namespace wrinkle::test
