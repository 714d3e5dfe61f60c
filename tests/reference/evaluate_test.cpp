// The evaluator on small frames of known surfaces: layers are compared with closed forms and with each other.
#include "tests/reference/evaluate.h"

#include <gtest/gtest.h>

#include "tests/reference/test_frame.h"

namespace wrinkle::reference {
namespace {

using V = Vec<double>;
constexpr Size size{40, 30};
const V slanted = normalize(V{0.1, -0.2, 1});

Image waves() {
    Image image{32, 16, 3, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                image.texels.push_back(static_cast<float>(0.6 + 0.3 * std::sin(0.7 * x + 1.1 * y + c)));
    return image;
}
const Images images{{"waves", waves()}};

Layer layer(decltype(Layer::bump) bump, double scale = 1) {
    Layer l;
    l.bump = std::move(bump);
    l.scale = scale;
    return l;
}
HeightMapLayer planar_height(double scale, Upscale upscale = Upscale::smooth) {
    HeightMapLayer l;
    l.texture.file = "waves";
    l.texture.upscale = upscale;
    l.uv.source = UvSource::planar;
    l.uv.scale = {scale, scale};
    return l;
}

struct Bumped {
    Camera camera = test_camera();
    TestFrame frame = plane_frame(camera, size, slanted);
    Scene scene;

    explicit Bumped(std::vector<Layer> layers) { scene.layers = std::move(layers); }
    SceneEvaluator<double> evaluator() const { return {scene, size, camera, frame.planes(), images}; }
    Evaluated<double> at(std::size_t i) const { return evaluator().evaluate(i); }
};

constexpr std::size_t pixels[] = {0, 41, 617, 1199};

void expect_same(const Bumped& a, const Bumped& b, double degrees) {
    const auto x = a.evaluator(), y = b.evaluator();
    double bumped = 0;
    for (const std::size_t i : pixels) {
        const Evaluated<double> e = x.evaluate(i), f = y.evaluate(i);
        EXPECT_LE(angle_degrees(e.normal, f.normal), degrees) << i;
        bumped = std::max(bumped, angle_degrees(e.normal, e.base_normal));
    }
    EXPECT_GT(bumped, 0.1) << "nothing happened";
}

TEST(Evaluate, NoLayersGiveTheDecodedNormal) {
    const Evaluated<double> e = Bumped({}).at(617);
    EXPECT_EQ(e.marked, 0);
    EXPECT_LE(angle_degrees(e.normal, slanted), 1e-5);
    EXPECT_TRUE(is_zero(e.surface_gradient));
}

TEST(Evaluate, ConstantGradientIsProjected) {
    const Evaluated<double> e = Bumped({layer(ConstantLayer{{0.3, 0.4, 5}}, 2)}).at(617);
    EXPECT_LE(relative_error(e.surface_gradient, tangent_part(V{0.6, 0.8, 10}, e.base_normal)), 1e-12);
    EXPECT_LE(angle_degrees(e.normal, e.base_normal - e.surface_gradient), 1e-12);
}

TEST(Evaluate, DepthAndPositionAgree) {
    Bumped depth({layer(planar_height(0.3), 0.5)}), position = depth, ray = depth;
    depth.scene.gbuffer.geometry = Geometry::depth;
    position.scene.gbuffer.geometry = Geometry::position;
    expect_same(depth, position, 1e-3);
    const CameraRays<double> rays(ray.camera, size);
    for (std::size_t i = 0; i < ray.frame.pixels["depth"].size(); ++i) {
        float& d = ray.frame.pixels["depth"][i];
        d = static_cast<float>(length(rays.at_depth(i % size.width + 0.5, i / size.width + 0.5, d)));
    }
    ray.scene.gbuffer.depth = DepthKind::ray;
    expect_same(depth, ray, 1e-3);
}

TEST(Evaluate, UvPlaneAgreesWithThePlanarProjectionItHolds) {
    for (const Camera& camera : {test_camera(), orthographic_camera()}) {
        Bumped planar({layer(planar_height(0.25), 0.5)}), aov = planar;
        planar.camera = aov.camera = camera;
        planar.frame = aov.frame = plane_frame(camera, size, slanted);
        HeightMapLayer h = planar_height(1);
        h.uv.source = UvSource::aov;
        h.texture.file = "waves";
        aov.scene.layers = {layer(h, 0.5)};
        // Differences of neighbours have the rounding of UV to float32 and, in perspective, one-sided errors at
        // borders.
        expect_same(planar, aov, camera.proj[3][3] == 1 ? 0.02 : 1.5);
        for (const char* name : {"dp_du.x", "dp_dv.y"}) aov.frame.add(name, 4);
        for (const char* name : {"dp_du.y", "dp_dv.x"}) aov.frame.add(name);
        aov.frame.add("dp_du.z", static_cast<float>(-4 * slanted.x / slanted.z));
        aov.frame.add("dp_dv.z", static_cast<float>(-4 * slanted.y / slanted.z));
        expect_same(planar, aov, 1e-3);
    }
}

TEST(Evaluate, TriplanarOnAnAxisPlaneIsItsPlanarHeightMap) {
    TriplanarLayer t;
    t.texture.file = "waves";
    t.tile = 2;
    Bumped triplanar({layer(t, 0.3)}), planar({layer(planar_height(0.5), 0.3)});
    triplanar.frame = planar.frame = plane_frame(triplanar.camera, size, {0, 0, 1});
    expect_same(triplanar, planar, 1e-9);
}

TEST(Evaluate, DecalInsideItsBoxIsAPlanarHeightMap) {
    DecalLayer d;
    d.texture.file = "waves";
    d.texture.upscale = Upscale::plain;
    d.center = {1, -1, 0};
    d.half_size = {100, 100, 100};
    d.falloff = 0;
    d.angle_fade = {-1, -1};
    HeightMapLayer h = planar_height(0.005, Upscale::plain);
    h.uv.offset = {0.5 - 0.005, 0.5 + 0.005};
    h.texture.wrap = Wrap::clamp;
    expect_same(Bumped({layer(d, 20)}), Bumped({layer(h, 20)}), 1e-9);
}

TEST(Evaluate, NoiseIsItsVolumeGradient) {
    Bumped run({layer(NoiseLayer{0.7, 3, 2, 0.5}, 0.2)});
    run.scene.layers[0].footprint = false;
    const Evaluated<double> e = run.at(617);
    const V g = fractal_sum({0.7, 3, 2, 0.5}, e.position + run.evaluator().frame().rays().eye(), 0.0).gradient * 0.2;
    EXPECT_LE(relative_error(e.surface_gradient, surface_gradient_from_volume(e.base_normal, g)), 1e-12);
}

TEST(Evaluate, SubtractUndoesAdd) {
    NormalMapLayer n;
    n.texture.file = "waves";
    n.uv.source = UvSource::planar;
    Bumped run({layer(n, 0.7), layer(n, 0.7)});
    run.scene.layers[1].blend = Blend::subtract;
    EXPECT_LE(length(run.at(617).surface_gradient), 1e-15);
}

TEST(Evaluate, ResolveStartsAStageOnTheResolvedNormal) {
    const ConstantLayer a{{0.3, 0, 0}}, b{{0, 0.4, 0.2}};
    Bumped run({layer(a), layer(ResolveLayer{}), layer(b)});
    const V middle = Bumped({layer(a)}).at(617).normal;
    const Evaluated<double> e = run.at(617);
    EXPECT_LE(angle_degrees(e.normal, middle - tangent_part(V{0, 0.4, 0.2}, middle)), 1e-12);
    EXPECT_NEAR(dot(e.last.dp_dx, middle), 0, 1e-15);
    EXPECT_NEAR(dot(e.base.dp_dx, e.base_normal), 0, 1e-15);
}

TEST(Evaluate, MasksMultiply) {
    Bumped run({layer(ConstantLayer{{1, 0, 0}})});
    const V whole = run.at(617).surface_gradient;
    run.frame.add("object", 3);
    run.frame.add("channel:dirt", 0.5);
    run.frame.add("crypto.id0", std::bit_cast<float>(cryptomatte_bits("Rock")));
    run.frame.add("crypto.coverage0", 0.25);
    Mask& mask = run.scene.layers[0].mask;
    const auto share = [&] { return dot(run.at(617).surface_gradient, whole) / dot(whole, whole); };
    mask.object = {3};
    EXPECT_NEAR(share(), 1, 1e-12);
    mask.channel = "dirt";
    mask.cryptomatte = {"Rock"};
    EXPECT_NEAR(share(), 0.125, 1e-12);
    mask.invert = true;  // the surface is the rock's, whatever else the pixel shows
    EXPECT_NEAR(share(), 0.5, 1e-12);
    mask = {};
    mask.object = {4};
    EXPECT_EQ(share(), 0);
}

TEST(Evaluate, InvalidPixelsPassThrough) {
    Bumped run({layer(ConstantLayer{{1, 0, 0}})});
    run.frame.pixels["depth"][0] = 1e10f;
    run.frame.pixels["normal.x"][1] = std::nanf("");
    run.frame.pixels["depth"][2] = -1;
    const V raw{double(run.frame.pixels["normal.x"][0]), double(run.frame.pixels["normal.y"][0]),
                double(run.frame.pixels["normal.z"][0])};
    for (const std::size_t i : {0, 1, 2}) {
        const Evaluated<double> e = run.at(i);
        EXPECT_EQ(e.marked, Marked::invalid);
        EXPECT_EQ(length(e.normal - (i == 1 ? V{} : raw)), 0);
        EXPECT_TRUE(is_zero(e.surface_gradient));
    }
}

TEST(Evaluate, BackFacingNormalsAreReflectedAndMarked) {
    Bumped run({});
    for (const char* name : {"normal.x", "normal.y", "normal.z"})
        for (float& f : run.frame.pixels[name]) f *= -2;
    const Evaluated<double> e = run.at(617);
    EXPECT_EQ(e.marked, Marked::back_facing);
    EXPECT_NEAR(dot(e.normal, e.view), dot(slanted, e.view), 1e-6);
}

TEST(Evaluate, UvWithoutNeighbourGivesZeroAndIsMarked) {
    HeightMapLayer h = planar_height(1);
    h.uv.source = UvSource::aov;
    Bumped run({layer(h)});
    run.frame.add("object");
    run.frame.pixels["object"][617] = 1;
    const Evaluated<double> e = run.at(617);
    EXPECT_EQ(e.marked, Marked::no_uv_derivative);
    EXPECT_TRUE(is_zero(e.surface_gradient));
    EXPECT_EQ(run.at(619).marked, 0);
}

TEST(Evaluate, RelightRatioOfAnUnchangedNormalIsTheBeauty) {
    Bumped run({});
    run.scene.lighting.relight = Relight::ratio;
    run.scene.lighting.lights = {{}};
    for (const char* name : {"beauty.r", "beauty.g", "beauty.b"}) run.frame.add(name, 0.25);
    const auto evaluator = run.evaluator();
    EXPECT_LE(length(evaluator.relit(617, evaluator.evaluate(617)) - V{0.25, 0.25, 0.25}), 1e-15);
    run.scene.lighting.relight = Relight::lit;
    const auto lit = run.evaluator();
    EXPECT_GT(lit.relit(617, lit.evaluate(617)).x, 0.1);
}

}  // namespace
}  // namespace wrinkle::reference
