// Layers that are joined with those below them, not added, count what these add in space only if there is some.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

Layer bumps_in_space() {
    Layer noise;
    noise.bump = NoiseLayer{.frequency = 2, .octaves = 1};
    noise.scale = 0.3, noise.footprint = false;
    return noise;
}

Layer joined_map(Combine combine) {
    NormalMapLayer weave{.texture = {.file = data_folder / "textures/weave_normal.png", .content = Content::normal}};
    weave.uv.source = UvSource::planar, weave.uv.axis_u = {1, 0, 0}, weave.uv.axis_v = {0, 1, 0};
    weave.combine = combine;
    Layer layer;
    layer.bump = weave, layer.footprint = false;
    return layer;
}

Spread error_of(std::vector<Layer> layers) {
    const HostFrame frame = small_frame();
    Scene scene;
    scene.filter.taps = 1;
    scene.layers = std::move(layers);
    scene = with_own_names(scene);
    return normal_error(evaluate_on(frame, scene), Truth(frame, scene));
}

TEST(Below, HoldsVolumeGradientsOfTheStage) {
    const Bounds bounds{2e-3, 6e-2, 0.4};  // of unfiltered texels; without what is below, the median is 1.3 or more
    for (const Combine combine : {Combine::rnm, Combine::whiteout})
        expect_within("over noise", error_of({bumps_in_space(), joined_map(combine)}), bounds, "degrees");
    expect_within("under noise", error_of({joined_map(Combine::rnm), bumps_in_space()}), bounds, "degrees");
    Layer resolve;
    resolve.bump = ResolveLayer{};
    expect_within("over resolved noise", error_of({bumps_in_space(), resolve, joined_map(Combine::rnm)}), bounds,
                  "degrees");
}

}  // namespace
}  // namespace wrinkle::test
