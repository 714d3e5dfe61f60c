// Planar mappings that see a surface edge on. Only rounding would decide where the bitangent points, so such a surface
// is not bumped.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

/// For a plane under a normal map that is projected along y: the largest angle between the results of standard, exact
/// and double, and the largest angle by which any of them turns the plane's normal, both in degrees.
struct Turned {
    double apart = 0, bumped = 0;
};

Turned turned(const V& normal) {
    const Camera camera = reference::tilted_camera();
    const HostFrame frame(plane_frame(camera, {64, 48}, normal), camera);
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    NormalMapLayer weave{.texture = {.file = data_folder / "textures/weave_normal.png", .content = Content::normal}};
    weave.uv.source = UvSource::planar, weave.uv.scale = {3, 3}, weave.uv.rotation = 0.5;
    weave.uv.axis_u = {1, 0, 0}, weave.uv.axis_v = {0, 0, 1};
    scene.layers[0].bump = weave, scene.layers[0].footprint = false;
    const auto by = [&](Precision precision) {
        return evaluate_on(frame, scene, {.precision = {precision, {precision}}});
    };
    const Pixels standard = by(Precision::standard), exact = by(Precision::exact);
    Pass in_double = evaluate(device(), scene, frame.frame, {.fp64 = true});
    const auto wide = run<double>(in_double, frame);
    Turned most;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const V want = vec_at(wide, "normal", i), base = vec_at(frame.pixels, "normal", i);
        const auto angle = [](V a, V b) { return std::atan2(length(cross(a, b)), dot(a, b)) * 57.29577951308232; };
        for (const Pixels* got : {&standard, &exact})
            most.apart = std::max(most.apart, angle(vec_at(*got, "normal", i), want));
        most.bumped = std::max(most.bumped, angle(base, want));
    }
    return most;
}

TEST(Planar, EdgeOnIsNotBumped) {
    const Turned edge_on = turned({0, 0, 1}), seen = turned(normalize(V{0, -0.01, 1}));
    EXPECT_LE(edge_on.bumped, 1e-5);
    EXPECT_LE(edge_on.apart, 1e-5);
    EXPECT_GT(seen.bumped, 5);
    EXPECT_LE(seen.apart, 0.5);  // the texels lie far from the origin and are not filtered
}

}  // namespace
}  // namespace wrinkle::test
