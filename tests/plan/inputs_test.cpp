// A plan reads only the planes that its scene needs, chooses the best of those that there are, and says which it lacks.
#include <fmt/format.h>

#include <algorithm>

#include "tests/plan/planned.h"

namespace wrinkle::test {
namespace {

TEST(PlanInputs, ReadsTheUvPlaneOnlyForLayersOnIt) {
    Layer planar = layer(normal_map());
    std::get<NormalMapLayer>(planar.bump).uv.source = UvSource::planar;
    const Plan without = make_plan(scene_of({planar, layer(NoiseLayer{}), layer(decal())}), everything());
    EXPECT_FALSE(mentions(without, "in_uv"));
    EXPECT_FALSE(mentions(without, "wr_texcoord_difference"));
    const Plan with = make_plan(scene_of({layer(normal_map())}), everything());
    EXPECT_TRUE(std::ranges::count(with.inputs, "uv.u") == 1 && std::ranges::count(with.inputs, "uv.v") == 1);
    EXPECT_FALSE(mentions(with, "wr_fractal"));
}

TEST(PlanInputs, TakesTheBestUvDerivativesThereAre) {
    const Scene scene = scene_of({layer(normal_map())});
    Available available = everything();
    const auto has = [&](const char* plane) {
        return std::ranges::count(make_plan(scene, available).inputs, plane) > 0;
    };
    EXPECT_TRUE(has("duv_dx.u") && !has("dp_du.x") && !has("object"));
    available.planes.erase("duv_dx.u");
    EXPECT_TRUE(!has("duv_dy.u") && has("dp_du.x") && !has("object"));
    EXPECT_FALSE(make_plan(scene, available).neighbours);
    available.planes.erase("dp_dv.z");
    EXPECT_TRUE(!has("dp_du.x") && has("object"));
    EXPECT_TRUE(make_plan(scene, available).neighbours);
    available.planes.erase("object");
    EXPECT_FALSE(has("object"));
}

TEST(PlanInputs, ParallaxMovesTheUvPlaneOnlyForLayersAfterIt) {
    ParallaxLayer depth;
    depth.texture.file = "stones.png";
    depth.uv.source = UvSource::planar;
    const auto plan = [&](std::vector<Layer> layers) { return make_plan(scene_of(std::move(layers)), everything()); };
    EXPECT_FALSE(mentions(plan({layer(depth), layer(NoiseLayer{})}), "uv"));
    EXPECT_FALSE(mentions(plan({layer(normal_map(), "first"), layer(depth)}), "uv.st = wr_add"));
    EXPECT_TRUE(mentions(plan({layer(depth), layer(normal_map(), "last")}), "uv.st = wr_add"));
    EXPECT_FALSE(plan({layer(depth)}).neighbours);
    depth.curved = true;
    EXPECT_TRUE(plan({layer(depth)}).neighbours);
    Layer deep = layer(depth, "deep");
    deep.scale = -1;
    expect_mentions(refusal(scene_of({deep}), everything()), {"deep", "scale is -1", "above 0"});
}

TEST(PlanInputs, PrefersDepthUnlessTheSceneOrTheCameraSaysOtherwise) {
    Scene scene = scene_of({});
    Available available = everything();
    const auto inputs = [&] { return make_plan(scene, available).inputs; };
    EXPECT_EQ(inputs().front(), "depth");
    available.camera = CameraKind::general;
    EXPECT_EQ(inputs().back(), "position.z");
    available.camera = CameraKind::parallel;
    EXPECT_EQ(inputs().front(), "depth");
    available.ray_depth = true;
    EXPECT_EQ(inputs().back(), "position.z");
    available = everything();
    scene.gbuffer.geometry = Geometry::position;
    EXPECT_EQ(inputs().back(), "position.z");
    scene.gbuffer.geometry = Geometry::depth;
    available.camera = CameraKind::general;
    expect_mentions(refusal(scene, available), {"depth", "pinhole", "position"});
}

TEST(PlanInputs, ComputesDerivativesOnlyForWhatUsesThem) {
    EXPECT_FALSE(mentions(make_plan(scene_of({layer(ConstantLayer{{1, 0, 0}})}), everything()), "dp_dx"));
    Layer noise = layer(NoiseLayer{});
    EXPECT_TRUE(mentions(make_plan(scene_of({noise}), everything()), "dp_dx"));
    noise.footprint = false;
    EXPECT_FALSE(mentions(make_plan(scene_of({noise}), everything()), "dp_dx"));
}

TEST(PlanInputs, NamesTheLayerAndThePlanesItLacks) {
    Available bare = everything();
    for (const char* plane : {"uv.u", "object", "crypto.id0", "channel:dirt", "beauty.g"}) bare.planes.erase(plane);
    Layer weave = layer(normal_map(), "weave");
    weave.location = "scene.toml:12";
    expect_mentions(refusal(scene_of({weave}), bare), {"scene.toml:12", "weave", "uv.u", "normal.x"});
    Layer masked = layer(ConstantLayer{}, "moss");
    masked.mask.object = {3};
    expect_mentions(refusal(scene_of({masked}), bare), {"moss", "object"});
    masked.mask = {};
    masked.mask.channel = "dirt";
    expect_mentions(refusal(scene_of({masked}), bare), {"moss", "dirt"});
    masked.mask = {};
    masked.mask.cryptomatte = {"Rock"};
    expect_mentions(refusal(scene_of({masked}), bare), {"moss", "crypto.id0"});
    masked.mask.cryptomatte = {"Rok"};
    expect_mentions(refusal(scene_of({masked}), everything()), {"moss", "\"Rok\"", "Rock, Wall"});
    Scene ratio = scene_of({});
    ratio.lighting.relight = Relight::ratio;
    expect_mentions(refusal(ratio, bare), {"ratio", "beauty.g"});
    bare.planes = {};
    expect_mentions(refusal(scene_of({}), bare), {"depth", "nothing"});
}

TEST(PlanInputs, CryptomatteNamesBecomeTheirHashes) {
    Layer masked = layer(ConstantLayer{{1, 0, 0}});
    masked.mask.cryptomatte = {"Rock"};
    const Scene scene = scene_of({masked});
    EXPECT_EQ(numbers(make_plan(scene, everything()), scene, "cryptomatte"), (std::vector<double>{0x1234, 0x5678}));
    masked.mask.cryptomatte = {"#0000beef"};
    const Scene other = scene_of({masked});
    EXPECT_EQ(numbers(make_plan(other, everything()), other, "cryptomatte"), (std::vector<double>{0, 0xbeef}));
}

TEST(PlanInputs, ListsAndPatternsBecomeTheHashesOfAllThatTheyName) {
    Available available = everything();
    available.cryptomatte = {{"Rock.1", 3u}, {"Rock.2", 1u}, {"Rocket", 2u},
                             {"Wall", 9u},   {"W*", 7u},     {"#0000beef", 8u}};
    Layer masked = layer(ConstantLayer{{1, 0, 0}}, "moss");
    const auto low_halves = [&](const std::vector<std::string>& names) {
        masked.mask.cryptomatte = names;
        const Scene scene = scene_of({masked});
        std::vector<double> low;
        const auto all = numbers(make_plan(scene, available), scene, "cryptomatte", available);
        for (std::size_t i = 1; i < all.size(); i += 2) low.push_back(all[i]);
        return low;
    };
    EXPECT_EQ(low_halves({"Rock.?"}), (std::vector<double>{1, 3}));
    EXPECT_EQ(low_halves({"Wall", "Rock*", "Rocket"}), (std::vector<double>{1, 2, 3, 9})) << "each once";
    EXPECT_EQ(low_halves({"W*"}), (std::vector<double>{7})) << "an object that is called so";
    EXPECT_EQ(low_halves({"*"}), (std::vector<double>{1, 2, 3, 7, 9})) << "hashes are no names";
    masked.mask.cryptomatte = {"Wall", "Moss*"};
    expect_mentions(refusal(scene_of({masked}), available), {"moss", "\"Moss*\"", "matches none", "Rock.1, Rock.2"});
    for (std::uint32_t i = 0; i < 2000; ++i) available.cryptomatte.emplace(fmt::format("leaf {}", i), 100 + i);
    masked.mask.cryptomatte = {"leaf*"};
    expect_mentions(refusal(scene_of({masked}), available), {"moss", "2000 Cryptomatte objects; at most 1024"});
}

TEST(PlanInputs, HeightsOfAChannelReadTheirNeighboursOnly) {
    const Plan plan = make_plan(scene_of({layer(HeightChannelLayer{"dirt"})}), everything());
    EXPECT_TRUE(plan.neighbours);
    EXPECT_EQ(plan.inputs, (Names{"channel:dirt", "depth", "normal.x", "normal.y", "normal.z", "object"}));
    expect_mentions(refusal(scene_of({layer(HeightChannelLayer{"dust"}, "wear")}), everything()),
                    {"wear", "the channel \"dust\"", "nearest: \"dirt\""});
}

}  // namespace
}  // namespace wrinkle::test
