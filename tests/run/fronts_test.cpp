// A leaf that is half transparent, over ground: each takes its own bumps where it is the surface that passes show.
#include <bit>

#include "io/front_objects.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

constexpr std::uint32_t kWidth = 21, kHeight = 6;
const std::uint32_t kGround = reference::cryptomatte_bits("Ground"), kLeaf = reference::cryptomatte_bits("Leaf");

bool on_leaf(std::size_t i) { return i % kWidth >= 7 && i % kWidth < 14; }

/// Ground with a leaf 10 % nearer in its middle, which lets so much of the ground be seen.
HostFrame leaf_over_ground(float opacity) {
    HostFrame frame(plane_frame(test_camera(), {kWidth, kHeight}, normalize(V{0.1, -0.2, 1})), test_camera());
    frame.frame.cryptomatte = {{"Ground", kGround}, {"Leaf", kLeaf}};
    for (const char* name : {"crypto.id0", "crypto.id1"}) frame.add(name, std::bit_cast<float>(kGround));
    frame.add("crypto.coverage0", 1), frame.add("crypto.coverage1", 0);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (!on_leaf(i)) continue;
        frame.pixels["depth"][i] *= 0.9f;
        const std::size_t leaf = opacity > 0.5f ? 0 : 1;
        frame.pixels[fmt::format("crypto.id{}", leaf)][i] = std::bit_cast<float>(kLeaf);
        frame.pixels[fmt::format("crypto.coverage{}", leaf)][i] = opacity;
        frame.pixels[fmt::format("crypto.coverage{}", 1 - leaf)][i] = 1 - opacity;
    }
    RoleMap roles;
    for (const auto& [plane, values] : frame.pixels) roles.channel_of[plane] = plane;
    roles.cryptomatte_ranks = 2;
    const io::FrontObjects fronts(roles);
    std::vector<const float*> needed;
    for (const std::string& name : fronts.needed()) needed.push_back(frame.pixels.at(name).data());
    std::vector<float> found(frame.count());
    fronts.find(needed, kWidth, found);
    frame.add("crypto.front") = found;
    return frame;
}

Scene masked(const std::string& object, bool invert) {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.5, 0, 0}};
    scene.layers[0].mask.cryptomatte = {object};
    scene.layers[0].mask.invert = invert;
    scene.output.surface_gradient = true;
    return scene;
}

TEST(Fronts, ALeafTakesNoBumpsOfTheGroundThatIsSeenThroughIt) {
    for (const float opacity : {0.3f, 0.5f, 0.8f}) {
        const HostFrame frame = leaf_over_ground(opacity);
        const double whole = length(vec_at(evaluate_on(frame, masked("Ground", false)), "surface_gradient", 0));
        ASSERT_GT(whole, 0.3);
        for (const bool invert : {false, true}) {
            const Pixels ground = evaluate_on(frame, masked(invert ? "Leaf" : "Ground", invert)),
                         leaf = evaluate_on(frame, masked(invert ? "Ground" : "Leaf", invert));
            for (std::size_t i = 0; i < frame.count(); ++i) {
                EXPECT_NEAR(length(vec_at(ground, "surface_gradient", i)), on_leaf(i) ? 0 : whole, 1e-5) << i;
                EXPECT_NEAR(length(vec_at(leaf, "surface_gradient", i)), on_leaf(i) ? opacity * whole : 0, 1e-5) << i;
            }
        }
        expect_within("leaf",
                      normal_error(evaluate_on(frame, masked("Leaf", true)), Truth(frame, masked("Leaf", true))),
                      {1e-4, 1e-3, 1e-3}, "degrees");
    }
}

TEST(Fronts, WithoutThatPlaneTheFirstRankIsInFront) {
    HostFrame frame = leaf_over_ground(0.8f);
    const Pixels known = evaluate_on(frame, masked("Leaf", false));
    frame.remove("crypto.front");
    EXPECT_EQ(evaluate_on(frame, masked("Leaf", false)).at("surface_gradient.x"), known.at("surface_gradient.x"));
}

TEST(Fronts, WhatAPictureShowsIsLeftWhoeverIsInFront) {
    HostFrame frame = leaf_over_ground(0.25f);
    for (const char color : {'r', 'g', 'b'}) frame.add(std::string("beauty.") + color, 0.5f);
    Scene scene = masked("Leaf", false);
    scene.layers[0].mask = {};
    scene.lighting.relight = Relight::ratio;
    scene.lighting.lights = {Light{.direction = {-0.6, 0, -0.8}}};
    const double whole = evaluate_on(frame, scene).at("lit.g")[10] - 0.5;
    scene.lighting.leave.emplace().cryptomatte = {"Ground"};
    EXPECT_NEAR(evaluate_on(frame, scene).at("lit.g")[10] - 0.5, 0.25 * whole, 1e-6);
}

}  // namespace
}  // namespace wrinkle::test
