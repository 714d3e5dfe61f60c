// A picture with fewer pixels than the frame is multiplied by the ratio of the sums of the light on the pixels of each.
#include <cmath>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

constexpr std::uint32_t kWidth = 24, kHeight = 12;

/// A plane whose normals turn from pixel to pixel, as at an edge, with a hole and an edge of its albedo within pixels
/// of its picture, which has one for scale x scale.
HostFrame uneven(std::uint32_t scale) {
    HostFrame frame(plane_frame(test_camera(), {kWidth, kHeight}, normalize(V{0.1, -0.2, 1})), test_camera());
    frame.frame.beauty_scale = scale;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const auto turn = static_cast<float>(i);
        frame.pixels["normal.x"][i] += 0.6f * std::sin(1.7f * turn);
        frame.pixels["normal.y"][i] += 0.5f * std::cos(2.3f * turn);
    }
    frame.pixels["normal.z"][5] = frame.pixels["normal.x"][5] = frame.pixels["normal.y"][5] = 0;
    for (const char color : {'r', 'g', 'b'}) {
        std::vector<float>& albedo = frame.add(std::string("albedo.") + color);
        for (std::size_t i = 0; i < albedo.size(); ++i) albedo[i] = i % kWidth < 11 ? 0.9f : 0.05f;
        std::vector<float>& beauty = frame.add(std::string("beauty.") + color);
        for (std::size_t i = 0; i < beauty.size(); ++i) {
            const std::size_t x = i % kWidth / scale, y = i / kWidth / scale;
            beauty[i] = 0.3f + 0.05f * static_cast<float>((7 * x + 3 * y + static_cast<std::size_t>(color)) % 11);
        }
    }
    return frame;
}

Scene lit_scene() {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, -0.3, 0}};
    scene.lighting.lights = {Light{.intensity = 3, .direction = {-0.5, 0.2, -0.8}},
                             Light{.kind = LightKind::point, .intensity = 20, .position = {1, -3, 4}}};
    scene.lighting.ambient = {0.3, 0.4, 0.5};
    scene.lighting.max_ratio = 3;
    return scene;
}

/// The light by itself, which is lit anew pixel by pixel; black where there is no surface.
Pixels light_of(const HostFrame& frame, Scene scene, double strength) {
    scene.lighting.relight = Relight::lit;
    scene.layers[0].scale = strength;
    return evaluate_on(frame, scene);
}

TEST(SummedLight, RatiosAreThoseOfTheSumsOverAPixelOfThePicture) {
    for (const std::uint32_t scale : {2u, 3u}) {
        const HostFrame frame = uneven(scale);
        Scene scene = lit_scene();
        const Pixels bumped = light_of(frame, scene, 1), bare = light_of(frame, scene, 0);
        scene.lighting.relight = Relight::ratio;
        double gap = 0;
        for (const bool split : {false, true}) {
            if (split && scale != 2) continue;
            const Pixels got = evaluate_on(frame, scene, {.split = split});
            for (std::size_t i = 0; i < frame.count(); ++i) {
                const std::string lit = "lit.g";
                double after = 0, before = 0;
                const std::size_t corner = i / kWidth / scale * scale * kWidth + i % kWidth / scale * scale;
                for (std::size_t k = 0; k < scale * scale; ++k) {
                    const std::size_t j = corner + k / scale * kWidth + k % scale;
                    after += bumped.at(lit)[j], before += bare.at(lit)[j];
                }
                const double few = 1e-4 * scale * scale;  // what keeps a ratio of nothing from being infinite
                const double ratio = i == 5 ? 1 : std::clamp((after + few) / (before + few), 1.0 / 3, 3.0);
                const double wanted = frame.pixels.at("beauty.g")[i] * ratio;
                gap = std::max(gap, std::abs(got.at(lit)[i] - wanted) / wanted);
            }
        }
        fmt::print("{} x {}: {:.1e}\n", scale, scale, gap);
        EXPECT_LE(gap, 5e-6) << scale;
    }
}

TEST(SummedLight, NormalsAndWhatIsLitAnewAreThoseOfThePixels) {
    HostFrame frame = uneven(2);
    Scene scene = lit_scene();
    scene.output.marked = scene.output.surface_gradient = true;
    scene.lighting.relight = Relight::ratio;
    const Pixels got = evaluate_on(frame, scene);
    frame.frame.beauty_scale = 1;
    const Pixels plain = evaluate_on(frame, scene);
    for (const auto& [name, values] : plain)
        if (!name.starts_with("lit.")) { EXPECT_EQ(got.at(name), values) << name; }
    EXPECT_NE(got.at("lit.g"), plain.at("lit.g"));
    scene.lighting.relight = Relight::lit;
    const Pixels anew = evaluate_on(frame, scene);
    frame.frame.beauty_scale = 2;
    EXPECT_EQ(evaluate_on(frame, scene).at("lit.g"), anew.at("lit.g"));
}

TEST(SummedLight, TheAreaOfPixelsIsWalkedAsEver) {
    const HostFrame frame = uneven(2);
    Scene scene = lit_scene();
    NoiseLayer noise;
    scene.layers[0].bump = noise;
    scene.layers[0].scale = 0.3;
    scene.lighting.relight = Relight::ratio;
    scene.lighting.shadows = Shadows::read;
    const Pixels got = evaluate_area(frame, scene);
    for (std::size_t i = 0; i < frame.count(); i += 2) {
        if (i / kWidth % 2 == 1 || i <= 5) continue;
        EXPECT_FLOAT_EQ(got.at("lit.r")[i], got.at("lit.r")[i + 1 + kWidth]) << i << ": one pixel of the picture";
    }
}

TEST(SummedLight, FramesAndRowsMustBeWholePixelsOfThePicture) {
    HostFrame frame = uneven(2);
    Scene scene = lit_scene();
    scene.lighting.relight = Relight::ratio;
    frame.frame.beauty_scale = 5;
    EXPECT_THROW(evaluate_on(frame, scene), Error);
    frame.frame.beauty_scale = 0;
    EXPECT_THROW(evaluate_on(frame, scene), Error);
}

}  // namespace
}  // namespace wrinkle::test
