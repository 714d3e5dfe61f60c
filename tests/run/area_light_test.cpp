// Scenes of lights with an extent: compiled in where there are some, and as bright as brute force over them.
#include "layers/kinds.h"
#include "run/pass_impl.h"
#include "tests/run/light_frames.h"

namespace wrinkle::test {
namespace {

std::vector<Light> extended() {
    return {Light{.intensity = 2, .direction = {-0.6, 0, -0.8}, .angle = 0.3},
            Light{.kind = LightKind::sphere, .intensity = 6, .position = {1, -1, 2}, .range = 30, .radius = 0.4},
            Light{.kind = LightKind::disc,
                  .intensity = 9,
                  .position = {-2, 1, 2},
                  .direction = {0.4, 0, -1},
                  .range = 4,
                  .radius = 0.5},
            Light{.kind = LightKind::rectangle,
                  .color = {0.5, 1, 1},
                  .intensity = 6,
                  .position = {0, 0, 3},
                  .direction = {0, 0, -1},
                  .range = 5,
                  .up = {0, 1, 0},
                  .size = {2, 0.5}}};
}

HostFrame tilted_plane() {
    HostFrame frame(plane_frame(test_camera(), {19, 11}, normalize(V{0.1, -0.2, 1})), test_camera());
    for (const char* color : {"r", "g", "b"}) frame.add(std::string("beauty.") + color, 0.5f);
    return frame;
}

TEST(AreaLights, LightAsBruteForceDoes) {
    const HostFrame frame = tilted_plane();
    for (const Relight relight : {Relight::lit, Relight::ratio}) {
        Scene scene = scene_lit_by(extended());
        scene.lighting.relight = relight;
        scene.lighting.roughness = 0.4;
        const Spread off = lit_error(evaluate_on(frame, scene), Truth(frame, scene));
        expect_within(relight == Relight::lit ? "lit" : "ratio", off, {2e-3, 1e-2, 2e-2}, "relative");
    }
}

TEST(AreaLights, OfNoExtentAreThoseThatHaveNone) {
    const HostFrame frame = tilted_plane();
    std::vector<Light> points{Light{.direction = {-0.6, 0, -0.8}},
                              Light{.kind = LightKind::point, .intensity = 6, .position = {1, -1, 2}}};
    std::vector<Light> none = points;
    none[1].kind = LightKind::sphere;
    Pass before = evaluate(device(), scene_lit_by(points), frame.frame),
         after = evaluate(device(), scene_lit_by(none), frame.frame);
    EXPECT_EQ(before.impl().plan.source, after.impl().plan.source);
    EXPECT_EQ(before.impl().plan.source.find("WR_AREA_LIGHTS"), std::string::npos);
    EXPECT_EQ(largest_difference(run(before, frame), run(after, frame)), 0);
    std::vector<Light> little = points;
    little[0].angle = 1e-4, little[1].kind = LightKind::sphere, little[1].radius = 1e-4;
    EXPECT_LT(largest_difference(run(before, frame), evaluate_on(frame, scene_lit_by(little))), 1e-4);
    EXPECT_THROW(before.set_parameters(scene_lit_by(little)), Error) << "whether there are any is compiled in";
}

/// Lamps that fade away within the frame, seen from before and from behind: nothing is lost, and nothing is NaN.
TEST(AreaLights, WithShortRangesLightOnlyWhatIsNear) {
    HostFrame frame = tilted_plane();
    std::vector<Light> lamps;
    for (int i = 0; i < 24; ++i) {
        const double x = i % 6 - 2.5, y = i / 6 - 1.5, side = i % 2 == 0 ? 1 : -1;
        Light lamp{.kind = i % 3 == 0   ? LightKind::disc
                           : i % 3 == 1 ? LightKind::rectangle
                                        : LightKind::sphere,
                   .intensity = 3,
                   .position = {x, y, side * 0.4},
                   .direction = {0.2, 0.1, -side},
                   .range = 0.6 + 0.1 * i,
                   .up = {0, 1, 0}};
        if (lamp.kind == LightKind::rectangle)
            lamp.size = {0.1, 0.004};
        else
            lamp.radius = 0.05;
        lamps.push_back(lamp);
    }
    const Scene scene = scene_lit_by(lamps);
    const Pixels got = evaluate_on(frame, scene);
    for (const auto& [name, plane] : got)
        for (const float v : plane) ASSERT_TRUE(std::isfinite(v)) << name;
    expect_within("short ranges", lit_error(got, Truth(frame, scene)), {2e-3, 2e-2, 5e-2}, "relative");
    Scene table = scene_lit_by({});
    table.lighting.table = std::make_shared<const std::vector<Light>>(lamps);
    EXPECT_LT(largest_difference(evaluate_on(frame, table), got), 1e-4);
}

TEST(AreaLights, OfATableAreTheSame) {
    const HostFrame frame = tilted_plane();
    std::vector<Light> lights = extended();
    lights.erase(lights.begin());
    Scene table = scene_lit_by({});
    table.lighting.table = std::make_shared<const std::vector<Light>>(lights);
    EXPECT_LT(largest_difference(evaluate_on(frame, table), evaluate_on(frame, scene_lit_by(lights))), 1e-5);
}

}  // namespace
}  // namespace wrinkle::test
