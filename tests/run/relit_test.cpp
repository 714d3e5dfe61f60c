// A picture that is relit by ratio beside the picture rendered again with the same bumps: never worse than unbumped.
#include <cmath>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

double srgb(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// Decibels by which a picture is off the one rendered with bumps, on pixels of one object; 0: on all.
double decibels(const HostFrame& frame, const Pixels& planes, const std::string& layer, const char* colours,
                int object) {
    const std::vector<float>& objects = frame.pixels.at("object");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (object != 0 && objects[i] != static_cast<float>(object)) continue;
        for (int c = 0; c < 3; ++c) {
            const float wanted = frame.pixels.at(std::string("channel:Bumped.") + "RGB"[c])[i];
            const double gap = srgb(planes.at(layer + colours[c])[i]) - srgb(wanted);
            sum += gap * gap, ++count;
        }
    }
    return -10 * std::log10(sum / count);
}

TEST(Relit, StandsCloserToTheRerenderThanTheUnbumpedPicture) {
    const HostFrame frame = data_frame("relit");
    Scene scene = load_scene(data_folder / "../bench/picture/relit.toml");
    for (const bool ambient : {false, true}) {
        if (ambient) scene.lighting.ambient = {0.3, 0.33, 0.4};
        const Pixels got = evaluate_on(frame, scene);
        for (const int object : {0, 1, 2, 3}) {
            const double before = decibels(frame, frame.pixels, "beauty.", "rgb", object);
            const double after = decibels(frame, got, "lit.", "rgb", object);
            fmt::print("{}, object {}: {:.1f} dB, unbumped {:.1f}\n", ambient ? "ambient" : "no ambient", object, after,
                       before);
            // Along the outline of the ball, which is metal, pixels are a mixture.
            EXPECT_GT(after, before - 0.1) << object;
            EXPECT_TRUE(!ambient || object != 0 || after > before + 3) << after;
        }
    }
}

TEST(Relit, MetalStaysAsItIs) {
    HostFrame frame(plane_frame(test_camera(), {19, 5}, normalize(V{0.1, -0.2, 1})), test_camera());
    for (const char color : {'r', 'g', 'b'}) {
        frame.add(std::string("beauty.") + color, 0.5f);
        std::vector<float>& albedo = frame.add(std::string("albedo.") + color, 0.25f);
        for (std::size_t i = 0; i < albedo.size(); i += 2) albedo[i] = 0;
    }
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{.direction = {-0.6, 0, -0.8}}};
    const Pixels got = evaluate_on(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i)
        for (const char color : {'r', 'g', 'b'})
            EXPECT_EQ(got.at(std::string("lit.") + color)[i] == 0.5f, i % 2 == 0) << i;
}

}  // namespace
}  // namespace wrinkle::test
