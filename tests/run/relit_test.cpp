// What relighting by ratio does with each part of a picture; tests/run/rerender_test.cpp has whole ones.
#include <cmath>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

TEST(Relit, WhereALightsPictureIsDarkBumpsOnlyTakeFromWhatIsAround) {
    HostFrame frame(plane_frame(test_camera(), {19, 5}, normalize(V{0.1, -0.2, 1})), test_camera());
    for (const char* color : {"R", "G", "B"}) {
        frame.add(std::string("beauty.") + static_cast<char>(std::tolower(color[0])), 0.5f);
        std::vector<float>& sun = frame.add(std::string("channel:Combined_sun.") + color, 0.4f);
        for (std::size_t i = 0; i < sun.size(); i += 2) sun[i] = 0;
        sun[1] = std::numeric_limits<float>::quiet_NaN();
    }
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{.direction = {-0.6, 0, -0.8}, .picture = "Combined_sun"}};
    const Pixels got = evaluate_on(frame, scene);
    const Truth truth(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const auto& at = truth.pixels[i];
        const double kept = 0.5 * reference::sky_keeps(at.normal, at.base_normal);
        EXPECT_LT(kept, 0.48);
        EXPECT_EQ(std::abs(got.at("lit.g")[i] - kept) < 2e-3, i % 2 == 0 || i == 1) << i << ": " << got.at("lit.g")[i];
        if (i != 1) {  // not finite, which the reference hands on
            EXPECT_NEAR(got.at("lit.g")[i], truth.lit[i].y, 1e-6) << i;
        }
    }
    scene.lighting.lights[0].picture = "Combined_sum", scene.lighting.lights[0].location = "scene.toml:7";
    try {
        evaluate_on(frame, scene);
        ADD_FAILURE() << "a picture that is not there";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find("scene.toml:7: light 1 has picture = \"Combined_sum\"; "), 0u) << text;
        EXPECT_NE(text.find("nearest: \"Combined_sun\""), std::string::npos) << text;
    }
}

/// A tilted plane with passes of all kinds, each different from pixel to pixel.
HostFrame passes_frame(const std::vector<std::string>& layers) {
    HostFrame frame(plane_frame(test_camera(), {19, 5}, normalize(V{0.1, -0.2, 1})), test_camera());
    float phase = 0;
    for (const std::string& layer : layers)
        for (const char color : {'r', 'g', 'b'}) {
            const bool role = !layer.starts_with("channel:");
            std::vector<float>& plane =
                frame.add(fmt::format("{}.{}", layer, role ? color : static_cast<char>(std::toupper(color))));
            const float size = layer == "beauty" ? 0.8f : 0.25f;
            phase += 1;
            for (std::size_t i = 0; i < plane.size(); ++i)
                plane[i] = size * (1.1f + std::sin(phase * 1.7f + 0.37f * static_cast<float>(i)));
        }
    return frame;
}

TEST(Relit, LobesGoEachByTheirOwnRatio) {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.3, -0.2, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.roughness = 0.4;
    Light sky{.kind = LightKind::sky};
    sky.zenith = {0.2, 0.3, 0.5}, sky.horizon = {0.4, 0.4, 0.4};
    scene.lighting.lights = {Light{.intensity = 2, .direction = {-0.6, 0, -0.8}}, sky,
                             Light{.direction = {0.5, 0.2, -0.8}, .picture = "lamp"},
                             Light{.direction = {0.1, 0.6, -0.8}, .diffuse = "matt", .specular = "gloss"},
                             Light{.direction = {0.2, -0.6, -0.8}, .specular = "shine"}};
    const std::vector<std::string> always{"beauty",       "albedo",        "channel:lamp",
                                          "channel:matt", "channel:gloss", "channel:shine"};
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"specular"}, {"specular_direct", "specular_indirect", "specular_color"}})
        for (const Shadows shadows : {Shadows::ignored, Shadows::read}) {
            std::vector<std::string> layers = always;
            layers.insert(layers.end(), more.begin(), more.end());
            const HostFrame frame = passes_frame(layers);
            scene.lighting.shadows = shadows;
            const Pixels got = evaluate_on(frame, scene);
            const Truth truth(frame, scene);
            double worst = 0;
            for (std::size_t i = 0; i < frame.count(); ++i)
                worst = std::max(worst, length(vec_at(got, "lit", i) - truth.lit[i]) / length(truth.lit[i]));
            fmt::print("{} specular passes, shadows {}: {:.1e}\n", more.size(),
                       shadows == Shadows::read ? "read" : "ignored", worst);
            EXPECT_LE(worst, 5e-6);
        }
}

TEST(Relit, WhetherTwoOrThreeLightsAreToldApartIsCompiledIn) {
    const HostFrame frame = passes_frame({"beauty", "albedo"});
    const auto with = [](std::size_t count) {
        Scene scene;
        scene.layers.resize(1);
        scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
        scene.lighting.relight = Relight::ratio, scene.lighting.shadows = Shadows::read;
        scene.lighting.lights.assign(count, Light{.direction = {-0.6, 0, -0.8}});
        return scene;
    };
    Pass two = evaluate(device(), with(2), frame.frame), one = evaluate(device(), with(1), frame.frame);
    Scene stronger = with(2);
    stronger.lighting.lights[1].intensity = 3;
    EXPECT_NO_THROW(two.set_parameters(stronger));
    for (const std::size_t count : {1, 3, 4}) EXPECT_THROW(two.set_parameters(with(count)), Error) << count;
    EXPECT_NO_THROW(one.set_parameters(with(4))) << "of four, as of one, all are read together";
    for (const std::size_t count : {2, 3}) EXPECT_THROW(one.set_parameters(with(count)), Error) << count;
}

TEST(Relit, WhatMirrorsTheSkyStaysAsItIs) {
    HostFrame frame = passes_frame({"beauty", "albedo"});
    for (const char color : {'r', 'g', 'b'})
        frame.add(std::string("specular.") + color) = frame.pixels.at(std::string("beauty.") + color);
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.ambient = {1, 1, 1};
    const Pixels got = evaluate_on(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) EXPECT_EQ(got.at("lit.g")[i], frame.pixels.at("beauty.g")[i]) << i;
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

TEST(Relit, MetalOfItsPassStaysAsItIsByItsShare) {
    HostFrame frame(plane_frame(test_camera(), {19, 5}, normalize(V{0.1, -0.2, 1})), test_camera());
    for (const char color : {'r', 'g', 'b'}) {
        frame.add(std::string("beauty.") + color, 0.5f);
        frame.add(std::string("albedo.") + color, 0);  // says nothing where the pass does
    }
    std::vector<float>& metallic = frame.add("metallic");
    for (std::size_t i = 0; i < metallic.size(); ++i) metallic[i] = static_cast<float>(i % 3) / 2;
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{.direction = {-0.6, 0, -0.8}}};
    const Pixels got = evaluate_on(frame, scene);
    const Truth truth(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        EXPECT_EQ(got.at("lit.g")[i] == 0.5f, i % 3 == 2) << i;
        EXPECT_NEAR(got.at("lit.g")[i], truth.lit[i].y, 1e-5) << i;
    }
}

MetalPicture some_metal(double object, double phase) {
    MetalPicture metal{.object = object};
    for (std::size_t k = 0; k < metal.seen.size(); ++k) {
        const double x = static_cast<double>(k % MetalPicture::kVertices),
                     y = static_cast<double>(k) / MetalPicture::kVertices;
        metal.seen[k] = {1.1 + std::sin(x / 3 + phase), 1.2 + std::cos(y / 4 + phase), 1.3 + std::sin((x + y) / 5)};
    }
    return metal;
}

TEST(Relit, MetalShowsWhatItsPictureDoesOfOtherDirections) {
    HostFrame frame = passes_frame({"beauty", "albedo"});
    std::vector<float>&object = frame.add("object"), &metallic = frame.add("metallic");
    for (std::size_t i = 0; i < object.size(); ++i)
        object[i] = static_cast<float>(i % 3 + 1), metallic[i] = i % 2 ? 1 : 0.75f;
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.3, -0.2, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{.direction = {-0.6, 0, -0.8}}};
    const auto two = [](double phase) {
        return std::make_shared<const std::vector<MetalPicture>>(std::vector{some_metal(1, phase), some_metal(2, 3)});
    };
    scene.lighting.metals = two(0);
    const Pixels got = evaluate_on(frame, scene);
    const Truth truth(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        EXPECT_LE(length(vec_at(got, "lit", i) - truth.lit[i]) / length(truth.lit[i]), 2e-5) << i;
        if (i % 2 == 0) continue;
        EXPECT_EQ(got.at("lit.r")[i] == frame.pixels.at("beauty.r")[i], i % 3 == 2)
            << i << ": the third has no picture";
    }
    Pass pass = evaluate(device(), scene, frame.frame);
    scene.lighting.metals = two(1);
    EXPECT_NO_THROW(pass.set_parameters(scene));
    scene.lighting.metals.reset();
    EXPECT_THROW(pass.set_parameters(scene), Error) << "how many metals there are is compiled in";
}

/// A tilted plane of grey, lit by a sun that a bump turns away from.
HostFrame grey_plane() {
    HostFrame frame(plane_frame(test_camera(), {19, 5}, normalize(V{0.1, -0.2, 1})), test_camera());
    for (const char color : {'r', 'g', 'b'}) frame.add(std::string("beauty.") + color, 0.5f);
    return frame;
}

Scene sunlit() {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{.direction = {-0.6, 0, -0.8}}};
    return scene;
}

TEST(Relit, WhatIsLeftStaysAsItIs) {
    HostFrame frame = grey_plane();
    std::vector<float>& object = frame.add("object", 1);
    for (std::size_t i = 0; i < object.size(); ++i) object[i] = static_cast<float>(i % 3);
    Scene scene = sunlit();
    scene.lighting.leave.emplace().object = {0, 2};
    const Pixels got = evaluate_on(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) EXPECT_EQ(got.at("lit.g")[i] == 0.5f, i % 3 != 1) << i;
    scene.lighting.leave->invert = true;
    EXPECT_EQ(evaluate_on(frame, scene).at("lit.g")[1], 0.5f);
    scene.lighting.leave->invert = false;
    scene.lighting.relight = Relight::lit;
    const Pixels anew = evaluate_on(frame, scene);
    for (std::size_t i = 0; i < frame.count(); ++i) EXPECT_EQ(anew.at("lit.g")[i] == 0.5f, i % 3 != 1) << i;
}

TEST(Relit, WhatSurfacesGiveOffOrLetThroughStaysAsItIs) {
    const HostFrame plain = grey_plane();
    const float whole = evaluate_on(plain, sunlit()).at("lit.g")[0];  // 0.5 times the ratio
    ASSERT_GT(std::abs(whole - 0.5f), 0.05f);
    const auto with = [&](std::initializer_list<std::pair<const char*, float>> layers) {
        HostFrame frame = grey_plane();
        for (const auto& [layer, value] : layers)
            for (const char color : {'r', 'g', 'b'}) frame.add(fmt::format("{}.{}", layer, color), value);
        return evaluate_on(frame, sunlit()).at("lit.g")[0];
    };
    EXPECT_NEAR(with({{"emission", 0.2f}}), 0.2f + 0.6f * whole, 1e-6);
    EXPECT_NEAR(with({{"emission", 0.5f}}), 0.5f, 1e-6);
    EXPECT_NEAR(with({{"transmission", 0.1f}}), 0.1f + 0.8f * whole, 1e-6);
    EXPECT_NEAR(with({{"emission", 0.1f}, {"transmission", 0.2f}}), 0.3f + 0.4f * whole, 1e-6);
    EXPECT_NEAR(with({{"transmission_direct", 0.1f}, {"transmission_indirect", 0.3f}, {"transmission_color", 0.5f}}),
                0.2f + 0.6f * whole, 1e-6);
    EXPECT_NEAR(with({{"emission", -1}}), whole, 1e-6);
    EXPECT_NEAR(with({{"transmission", 9}}), 0.5f, 1e-6);
    EXPECT_NEAR(with({{"emission", std::numeric_limits<float>::quiet_NaN()}}), whole, 1e-6);
}

}  // namespace
}  // namespace wrinkle::test
