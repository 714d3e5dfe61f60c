// A bump of the user's own whose gradient duals compute, against the same formula with its gradient written by hand.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

Pixels dented(const HostFrame& frame, const std::filesystem::path& file) {
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].scale = 0.05;
    scene.layers[0].bump = KernelLayer{
        .file = file, .function = "dents", .parameters = {{"spacing", 0.35}, {"radius", 0.45}, {"depth", 1.0}}};
    return evaluate_on(frame, scene);
}

TEST(UserKernel, DualsGiveTheGradientWrittenByHand) {
    const Camera camera = reference::tilted_camera();
    const V up{0, 0, 1};
    const HostFrame frame(plane_frame(camera, {96, 64}, up), camera);
    const std::filesystem::path source = WRINKLE_SOURCE_DIR;
    const Pixels duals = dented(frame, source / "data/kernels/dents.clh");
    const Pixels by_hand = dented(frame, source / "bench/kernels/dents_by_hand.clh");
    double apart = 0, bumped = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const V a = vec_at(duals, "normal", i), b = vec_at(by_hand, "normal", i);
        const auto angle = [](V v, V w) { return std::atan2(length(cross(v, w)), dot(v, w)) * 57.29577951308232; };
        apart = std::max(apart, angle(a, b));
        bumped = std::max(bumped, angle(b, up));
    }
    EXPECT_GT(bumped, 5) << "the dents show";
    EXPECT_LE(apart, 1e-3);
}

}  // namespace
}  // namespace wrinkle::test
