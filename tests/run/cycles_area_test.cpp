// What a height map's bump shows over whole pixels, against other people's software: the normals of the Bump node of
// Blender Cycles, averaged over each pixel at the frame's own resolution (data/make/render_cycles_area.py), from a
// material that only scatters, whose normals Cycles does not bend. On the torus and the low swells the map is coarser
// than pixels; the plain is one of cobbles to the horizon, most of them far smaller than a pixel is long. There 1024
// points of the same map, evaluated outside of wrinkle, are 0.7 to 1.1 degrees off Cycles' 256 in the median.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

struct AreaCase {
    const char* name;
    double median, p99;  ///< upper bounds of the differences, degrees
    double bump;         ///< lower bound of the median angle by which Cycles tilts normals, degrees
};

Layer cobbles() {
    HeightMapLayer map{};
    map.texture.file = data_folder / "textures/cobbles_height.png";
    map.uv.scale = {0.55, 0.55};
    Layer layer;
    layer.bump = map;
    layer.scale = 0.05;
    return layer;
}

/// What bumps a surface as Cycles did.
Scene scene_of(const std::string& name) {
    Scene scene;
    if (name == "cycles_plain")
        scene.layers = {cobbles()};
    else
        scene = load_scene(data_folder / "scenes" / (name + ".toml"));
    scene.lighting = {};
    return scene;
}

class CyclesArea : public testing::TestWithParam<AreaCase> {};

TEST_P(CyclesArea, IsWhatHeightMapsShowOfAPixel) {
    const AreaCase& expected = GetParam();
    const std::string name = expected.name;
    const HostFrame frame = data_frame(name + "_area");
    const Pixels got = evaluate_area(frame, scene_of(name), {});
    std::vector<double> errors, bumps;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (!(frame.pixels.at("depth")[i] < 1e9f)) continue;
        const auto part = [&](const char* axis) {
            return static_cast<double>(frame.pixels.at("channel:ViewLayer.BumpedNormal." + std::string(axis))[i]);
        };
        const V cycles = normalize(V{part("X"), part("Y"), part("Z")});
        errors.push_back(angle_degrees(vec_at(got, "normal", i), cycles));
        bumps.push_back(angle_degrees(normalize(vec_at(frame.pixels, "normal", i)), cycles));
    }
    print(name + ": Cycles' bump", Spread(bumps), "degrees");
    expect_within(name + ": difference", Spread(errors), {expected.median, expected.p99, 45}, "degrees");
    EXPECT_GE(Spread(bumps).median, expected.bump);
}

INSTANTIATE_TEST_SUITE_P(Frames, CyclesArea,
                         testing::Values(AreaCase{"cycles_torus", 0.1, 1, 5}, AreaCase{"cycles_ground", 0.1, 0.3, 5},
                                         AreaCase{"cycles_plain", 2.2, 12, 9}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace wrinkle::test
