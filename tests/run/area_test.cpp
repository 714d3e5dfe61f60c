// What a pixel's area shows, by brute force: the mean of surface gradients, their covariance and their light at many
// points is what a pass must give.
#include "tests/run/area_truth.h"

namespace wrinkle::test {
namespace {

/// By how much the areas' normals tilt from the ground.
Spread tilts(const std::vector<Area>& areas) {
    std::vector<double> all;
    for (const Area& area : areas)
        if (area.whole) all.push_back(angle_degrees(normal_of(area.gradient), V{0, 0, 1}));
    return Spread(all);
}

struct AreaCase {
    std::string name;
    Layer layer;
    double median, share;  ///< bounds: degrees; of the error of one point a pixel
};

/// One of every kind that varies over a pixel. Bounds are about 1.5 times what was measured; ridges weigh octaves
/// by one another, and gain least.
std::vector<AreaCase> area_cases() {
    const Layer height = layer_of(HeightMapLayer{{.file = cobbles}, planar}, 0.3);
    const Layer normal = layer_of(NormalMapLayer{{.file = weave, .content = Content::normal}, planar}, 1);
    NoiseLayer sum{.frequency = 0.4, .octaves = 4}, ridges = sum;
    ridges.fractal = FractalKind::ridged;
    Layer masked = height;
    masked.mask.texture = MaskTexture{.file = cobbles, .uv = planar};
    Layer masked_noise = layer_of(sum, 0.3);
    masked_noise.mask.texture = masked.mask.texture;
    DecalLayer box{.texture = {.file = cobbles}, .center = {0, 0, 0}, .half_size = {5, 5, 0.5}};
    return {{"height_map", height, 2, 0.3},
            {"height_map by uv", layer_of(HeightMapLayer{{.file = cobbles}, {.scale = {0.32, 0.32}}}, 0.3), 2.1, 0.3},
            {"normal_map", normal, 0.9, 0.45},
            {"noise", layer_of(sum, 0.3), 1.2, 0.4},
            {"ridged noise", layer_of(ridges, 0.2), 2.4, 0.7},
            {"triplanar", layer_of(TriplanarLayer{.texture = {.file = cobbles}, .tile = 12}, 0.3), 2.4, 0.35},
            {"masked by texture", masked, 1, 0.35},
            {"noise masked by texture", masked_noise, 1, 0.5},
            {"decal", layer_of(box, 0.3), 2, 0.3}};
}

class AreaCases : public testing::TestWithParam<AreaCase> {};

TEST_P(AreaCases, AreTheMeanOverThePixel) {
    const auto& [name, layer, median, share] = GetParam();
    const std::vector<Area> areas = brute_force(scene_of(layer));
    const HostFrame frame = ground(kSize);
    const Spread many = errors(evaluate_area(frame, scene_of(layer)), areas);
    const Spread one = errors(evaluate_area(frame, scene_of(layer, 1)), areas);
    print(name + ": tilt", tilts(areas), "degrees"), print(name + ": 16 taps", many, "degrees");
    print(name + ": 1 tap", one, "degrees");
    EXPECT_EQ(many.non_finite, 0u);
    EXPECT_LE(many.median, median);
    EXPECT_LE(many.median, share * one.median);
}

INSTANTIATE_TEST_SUITE_P(Layers, AreaCases, testing::ValuesIn(area_cases()), [](const auto& info) {
    std::string name = info.param.name;
    std::ranges::replace(name, ' ', '_');
    return name;
});

TEST(Area, CovarianceIsThatOfTheSlopes) {
    for (const AreaCase& each : area_cases()) {
        if (each.name == "ridged noise" || each.name.ends_with("masked by texture") || each.name == "triplanar" ||
            each.name == "decal")
            continue;  // these tell what differs between points only
        const std::vector<Area> areas = brute_force(scene_of(each.layer));
        const Pixels got = evaluate_area(ground(kSize), scene_of(each.layer));
        std::vector<Area> found = areas;
        double correlation = 0;
        for (std::size_t i = 0; i < areas.size(); ++i) {
            found[i].xx = got.at("slope_covariance.xx")[i], found[i].yy = got.at("slope_covariance.yy")[i];
            found[i].xy = got.at("slope_covariance.xy")[i];
            EXPECT_GE(found[i].xx * found[i].yy * (1 + 1e-4) + 1e-9, found[i].xy * found[i].xy) << each.name << i;
            if (areas[i].whole) correlation += found[i].xy * areas[i].xy;
        }
        fmt::print("{}: sigma {:.3f}, true {:.3f}\n", each.name, sigma(found), sigma(areas));
        EXPECT_NEAR(sigma(found) / sigma(areas), 1, 0.2) << each.name;
        EXPECT_GE(correlation, 0) << each.name << ": the signs of xy";
    }
}

TEST(Area, RoughnessGrowsByTheVariance) {
    Scene scene = scene_of(area_cases()[0].layer);
    scene.output.roughness = true;
    scene.lighting.roughness = 0.3;
    const Pixels got = evaluate_area(ground(kSize), scene);
    for (std::size_t i = 0; i < got.at("roughness").size(); ++i) {
        const double variance = double{got.at("slope_covariance.xx")[i]} + got.at("slope_covariance.yy")[i];
        EXPECT_NEAR(got.at("roughness")[i], std::min(std::pow(0.0081 + variance, 0.25), 1.0), 1e-5);
    }
}

double decibels(const Pixels& got, const std::vector<Area>& areas) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (!areas[i].whole) continue;
        const double gap = std::clamp<double>(got.at("lit.r")[i], 0, 1) - std::clamp(areas[i].lit.x, 0.0, 1.0);
        sum += gap * gap, ++count;
    }
    return -10 * std::log10(sum / count);
}

TEST(Area, LightFallsOnEveryPoint) {
    Scene scene = scene_of(area_cases()[0].layer);
    scene.lighting.relight = Relight::lit;
    scene.lighting.ambient = {0.05, 0.05, 0.05}, scene.lighting.roughness = 0.3;
    scene.lighting.lights = {Light{.color = {3, 3, 3}, .direction = {0.66, 0.72, -0.42}}};
    const std::vector<Area> areas = brute_force(scene);
    const HostFrame frame = ground(kSize);
    const double at_points = decibels(evaluate_area(frame, scene), areas);
    scene.filter.light_mean = true;
    const double of_mean = decibels(evaluate_area(frame, scene), areas);
    scene.filter = {.taps = 1};
    const double one = decibels(evaluate_area(frame, scene), areas);
    fmt::print("lit: {:.1f} dB; by the mean normal {:.1f}; of one point {:.1f}\n", at_points, of_mean, one);
    EXPECT_GT(at_points, 36);
    EXPECT_GT(at_points, of_mean + 3);
    EXPECT_GT(of_mean, one + 3);
}

TEST(Area, RoundFootprintsTakeOnePoint) {
    const Camera camera{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -5}, {0, 0, 0, 1}}},
                        {{{20, 0, 0, 0}, {0, 20, 0, 0}, {0, 0, -1.002, -0.2002}, {0, 0, -1, 0}}}};
    const HostFrame frame(plane_frame(camera, {32, 32}, {0, 0, 1}), camera);
    const Layer height = area_cases()[0].layer;
    Scene many = scene_of(height), one = scene_of(height, 1);
    many.output = one.output = {};
    const Pixels a = evaluate_area(frame, many), b = evaluate_area(frame, one);
    EXPECT_LT(largest_difference(a, b), 2e-3);
}

TEST(Area, DoesNotDependOnThePixelsOfAWorkItem) {
    const HostFrame frame = ground(kSize);
    const auto cases = area_cases();
    const Scene scene = scene_of(std::ranges::find(cases, "noise masked by texture", &AreaCase::name)->layer);
    EXPECT_LT(largest_difference(evaluate_area(frame, scene, {.lanes = 1}), evaluate_area(frame, scene, {.lanes = 4})),
              2e-3);
}

TEST(Area, OnePointIsTheSameWithCovariance) {
    const HostFrame frame = ground(kSize);
    const Layer layer = area_cases()[0].layer;
    Scene plain = scene_of(layer, 1);
    plain.output = {.surface_gradient = true};
    const Pixels with = evaluate_area(frame, scene_of(layer, 1));
    EXPECT_LT(largest_difference(evaluate_area(frame, plain), with), 2e-5);
}

TEST(Area, TexelsThatAPixelResolvesAreNotRough) {
    // A texel is 1 / 512 of 40 m and more than ten pixels wide.
    const Camera camera{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -5}, {0, 0, 0, 1}}},
                        {{{20, 0, 0, 0}, {0, 20, 0, 0}, {0, 0, -1.002, -0.2002}, {0, 0, -1, 0}}}};
    const HostFrame frame(plane_frame(camera, {96, 96}, {0, 0, 1}), camera);
    const UvMapping wide{.source = UvSource::planar, .scale = {0.025, 0.025}};
    const Pixels got =
        evaluate_area(frame, scene_of(layer_of(NormalMapLayer{{.file = weave, .content = Content::normal}, wide}, 1)));
    for (std::size_t i = 0; i < frame.count(); ++i) EXPECT_LT(got.at("slope_covariance.xx")[i], 1e-2) << "pixel " << i;
}

TEST(Area, SequencesOfStagesAddTheirCovariances) {
    Layer height = area_cases()[0].layer, resolve, noise = area_cases()[3].layer;
    height.name = "height", resolve.bump = ResolveLayer{}, resolve.name = "resolve", noise.name = "noise";
    Scene both = scene_of(height), first = both;
    both.layers = {height, resolve, noise};
    const Pixels a = evaluate_area(ground(kSize), both), b = evaluate_area(ground(kSize), first);
    double grown = 0;
    for (std::size_t i = 0; i < kSize.width * kSize.height; ++i) {
        EXPECT_GE(a.at("slope_covariance.xx")[i] + 1e-6f, b.at("slope_covariance.xx")[i]);
        grown += a.at("slope_covariance.xx")[i] - b.at("slope_covariance.xx")[i];
    }
    EXPECT_GT(grown, 0.1);
}

}  // namespace
}  // namespace wrinkle::test
