// What a scene does not need is not computed, and leaving it out changes nothing else.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

Layer constant_on(double object) {
    Layer layer;
    layer.name = fmt::format("tilt of object {}", object);
    layer.bump = ConstantLayer{.gradient = {0.3, -0.2, 0.4}};
    layer.mask.object = {object};
    return layer;
}

Layer resolve_layer() {
    Layer layer;
    layer.bump = ResolveLayer{};
    return layer;
}

Layer noise_layer() {
    Layer layer;
    layer.name = "grain";
    layer.bump = NoiseLayer{.frequency = 9, .octaves = 5};  // with a footprint, so that it needs the derivatives
    layer.scale = 0.02;
    return layer;
}

TEST(Spared, NormalsThatNothingBendsKeepTheirBits) {
    const HostFrame frame = small_frame();
    Scene none = data_scene("constant"), some = none;
    none.layers.clear();
    some.layers = {resolve_layer(), constant_on(1), resolve_layer(), constant_on(1), resolve_layer(), constant_on(2)};
    some = with_own_names(some);
    const Pixels before = evaluate_on(frame, none), after = evaluate_on(frame, some);
    std::size_t kept = 0, bent = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const float object = frame.pixels.at("object")[i];
        if (object == 1 || object == 2)
            ++bent;
        else
            for (const char* axis : {"normal.x", "normal.y", "normal.z"})
                kept += before.at(axis)[i] == after.at(axis)[i] ? 1 : 0;
    }
    EXPECT_GT(bent, frame.count() / 50);
    EXPECT_EQ(kept, 3 * (frame.count() - bent));
    expect_within("bent twice", normal_error(after, Truth(frame, some)), {3e-6, 1e-5, 3e-5}, "degrees");
}

/// Derivatives may be needed by the last stage only, by two stages in a row, or again after a stage that needs none.
TEST(Spared, EveryStageHasTheDerivativesOfItsOwnSurface) {
    const HostFrame frame = small_frame();
    const Layer tilt = constant_on(1), other = constant_on(3), noise = noise_layer(), resolve = resolve_layer();
    const std::vector<std::vector<Layer>> orders{{tilt, resolve, other, resolve, noise},
                                                 {tilt, resolve, noise, resolve, noise},
                                                 {noise, resolve, tilt, resolve, noise},
                                                 {resolve, noise}};
    for (const std::vector<Layer>& order : orders) {
        Scene scene = data_scene("constant");
        scene.layers = order;
        scene = with_own_names(scene);
        const Truth truth(frame, scene);
        std::string what;
        for (const Layer& layer : order) what += std::string(layer.kind()) + " ";
        for (const PassOptions& options : {PassOptions{}, PassOptions{.split = true}})
            expect_within(what, normal_error(evaluate_on(frame, scene, options), truth), {6e-5, 3e-3, 7e-3}, "degrees");
    }
}

/// Pixels that a parallax moves and turns may share a work-item with pixels outside of its mask, which must stay as
/// they are.
TEST(Spared, ParallaxLeavesOthersAsTheyAre) {
    const HostFrame frame = small_frame();
    Scene still = data_scene("parallax");
    std::erase_if(still.layers, [](const Layer& layer) { return layer.name != "depth of the torus"; });
    ASSERT_EQ(still.layers.size(), 1u);
    constexpr float torus = 3;
    still.layers[0].mask = {};
    still.layers[0].mask.object = {torus};
    still.layers.push_back(constant_on(1));
    still.output.dp_dx = still.output.dp_dy = true;
    Scene moved = still;
    still.layers.erase(still.layers.begin());
    const Pixels before = evaluate_on(frame, still), after = evaluate_on(frame, moved);
    std::size_t differing = 0, turned = 0;
    for (std::size_t i = 0; i < frame.count(); ++i)
        for (const char* plane : {"dp_dx.x", "dp_dx.y", "dp_dx.z", "dp_dy.x", "dp_dy.y", "dp_dy.z", "normal.x"})
            (frame.pixels.at("object")[i] == torus ? turned : differing) += before.at(plane)[i] != after.at(plane)[i];
    EXPECT_EQ(differing, 0u);
    EXPECT_GT(turned, 100u);
}

/// Texture coordinates are differentiated only where a mask lets some layer use them.
TEST(Spared, MasksDoNotChangeWhatTextureCoordinatesAre) {
    const HostFrame frame = small_frame();
    const Layer stones = data_scene("height_map").layers.at(1);
    std::vector<Mask> masks(4);
    masks[0].object = {1};
    masks[1].object = {1}, masks[1].invert = true;
    masks[2].cryptomatte = {frame.frame.cryptomatte.begin()->first};
    masks[3] = stones.mask, masks[3].texture = MaskTexture{.file = data_folder / "textures/cobbles_height.png"};
    masks[3].object = {2};
    for (std::size_t k = 0; k < masks.size(); ++k) {
        Scene scene = data_scene("height_map");
        scene.layers = {stones};
        scene.layers[0].mask = masks[k];
        scene.output.marked = false;  // else every pixel needs them, to mark where there are none
        const Truth truth(frame, scene);
        const Pixels spared = evaluate_on(frame, scene);
        expect_within(fmt::format("mask {}", k), normal_error(spared, truth), {3e-6, 2e-4, 1e-3}, "degrees");
        scene.output.marked = true;
        const Pixels all = evaluate_on(frame, scene);
        for (const char* axis : {"normal.x", "normal.y", "normal.z"}) EXPECT_EQ(spared.at(axis), all.at(axis)) << k;
    }
}

}  // namespace
}  // namespace wrinkle::test
