// Gradients that channels of the frame hold; each layer's own gradient as an output.
#include <cmath>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

/// The scene gradient.toml, with a second layer that subtracts what it reads, unprojected.
Scene two_gradients() {
    Scene scene = data_scene("gradient");
    scene.lighting = {};
    Layer less = scene.layers.at(0);
    less.name = "less", less.scale = 0.03, less.blend = Blend::subtract, less.project = false, less.mask = {};
    scene.layers.push_back(less);
    scene.output.surface_gradient = true;
    return scene;
}

TEST(Gradients, ThatAreNotFiniteAddNothingAndAreMarked) {
    HostFrame frame = small_frame();
    Scene scene = two_gradients();
    std::vector<float>& x = frame.pixels.at("channel:ViewLayer.Position.X");
    const float broken[] = {NAN, INFINITY, -INFINITY};
    for (std::size_t i = 0; i < x.size(); i += 7) x[i] = broken[i % 3];
    const Truth truth(frame, scene);
    const Pixels got = evaluate_on(frame, scene);
    EXPECT_EQ(marked_differences(got, truth), 0u);
    EXPECT_GT(std::ranges::count_if(got.at("marked"), [](float m) { return (static_cast<int>(m) & 4) != 0; }), 500);
    expect_within("broken channels", normal_error(got, truth), {3e-6, 2e-5, 5e-5}, "degrees");
}

TEST(Gradients, OfOtherFilesComeAsPlanesOfTheirOwn) {
    HostFrame frame = small_frame();
    Scene scene = two_gradients();
    const Pixels of_channels = evaluate_on(frame, scene);
    auto& first = std::get<GradientLayer>(scene.layers[0].bump);
    const std::array<std::string, 3> names{first.channels[0], first.channels[1], first.channels[2]};
    first = {.camera_space = true};
    EXPECT_THROW(evaluate_on(frame, scene), Error);
    for (std::size_t k = 0; k < 3; ++k)
        frame.add(std::string("gradient0.") + "xyz"[k]) = frame.pixels.at("channel:" + names[k]);
    EXPECT_EQ(largest_difference(of_channels, evaluate_on(frame, scene)), 0);
}

/// Each layer's own gradient, added up, is that of all; and asking for it changes nothing else.
TEST(LayersByThemselves, SumUpAndLeaveTheRestAsItIs) {
    const HostFrame frame = small_frame();
    Scene scene = data_scene("decals");
    scene.lighting = {};
    scene.layers.push_back(data_scene("parallax").layers.at(0));
    scene.layers.push_back(data_scene("constant").layers.at(0));
    scene = with_own_names(scene);
    scene.output.surface_gradient = true;
    scene.filter.taps = 4;
    const Pixels all = evaluate_area(frame, scene);
    scene.output.layers = true;
    const Pixels each = evaluate_area(frame, scene);
    std::vector<V> sum(frame.count());
    double most = 0, gap = 0;
    for (std::size_t k = 0; k < scene.layers.size(); ++k) {
        const std::string plane = fmt::format("layer{}", k);
        EXPECT_EQ(each.contains(plane + ".x"), !std::holds_alternative<ParallaxLayer>(scene.layers[k].bump));
        double own = 0;
        for (std::size_t i = 0; each.contains(plane + ".x") && i < sum.size(); ++i) {
            sum[i] = sum[i] + vec_at(each, plane, i);
            own = std::max(own, length(vec_at(each, plane, i)));
        }
        EXPECT_TRUE(own > 0.05 || !each.contains(plane + ".x")) << scene.layers[k].name;
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        most = std::max(most, length(sum[i]));
        gap = std::max(gap, length(sum[i] - vec_at(each, "surface_gradient", i)));
    }
    fmt::print("layers of {:.3g} at most sum up to all but {:.2e}\n", most, gap);
    EXPECT_LE(gap, 2e-6 * most);
    EXPECT_LE(largest_difference(all, each), 1e-5);
}

}  // namespace
}  // namespace wrinkle::test
