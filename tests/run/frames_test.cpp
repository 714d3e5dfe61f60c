// Frames of odd sizes, with broken pixels, and with every kind of camera and geometry, compared with the
// double-precision evaluator.
#include <cmath>
#include <random>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using reference::CameraRays;

const V slanted = normalize(V{0.1, -0.2, 1});

/// A scene of a normal map on the UV plane, a planar height map and noise, with textures of data/.
Scene small_scene() {
    Scene scene;
    scene.filter.taps = 1;
    NormalMapLayer weave;
    weave.texture.file = data_folder / "textures/weave_normal.png";
    HeightMapLayer cobbles;
    cobbles.texture.file = data_folder / "textures/cobbles_height.png";
    cobbles.uv = {.source = UvSource::planar, .scale = {0.2, 0.2}};
    scene.layers.resize(3);
    scene.layers[0].bump = weave, scene.layers[0].name = "weave";
    scene.layers[1].bump = cobbles, scene.layers[1].name = "cobbles", scene.layers[1].scale = 0.05;
    scene.layers[2].bump = NoiseLayer{.frequency = 1}, scene.layers[2].name = "noise", scene.layers[2].scale = 0.1;
    scene.output = {.surface_gradient = true, .dp_dx = true, .dp_dy = true, .marked = true};
    return scene;
}

/// Compares everything that small_scene writes with the reference.
void expect_agreement(const std::string& what, const HostFrame& frame, const Scene& scene) {
    const Truth truth(frame, scene);
    const Pixels got = evaluate_on(frame, scene);
    expect_within(what, normal_error(got, truth), {1.6e-4, 1e-3, 3e-3}, "degrees");
    EXPECT_EQ(marked_differences(got, truth), 0u) << what;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const auto& want = truth.pixels[i];
        EXPECT_LE(length(vec_at(got, "dp_dx", i) - want.base.dp_dx), 1e-4 * length(want.base.dp_dx)) << what << i;
        EXPECT_LE(length(vec_at(got, "dp_dy", i) - want.base.dp_dy), 1e-4 * length(want.base.dp_dy)) << what << i;
        EXPECT_LE(length(vec_at(got, "surface_gradient", i) - want.surface_gradient), 1e-4) << what << i;
    }
}

TEST(Frames, OfEverySize) {
    for (const Size size : {Size{37, 23}, {1, 1}, {1, 19}, {19, 1}, {2, 67}, {131, 2}}) {
        Camera camera = test_camera();  // pixels of one size
        camera.proj[0][0] *= 60.0 / size.width;
        camera.proj[1][1] *= 45.0 / size.height;
        expect_agreement(fmt::format("{} x {}", size.width, size.height),
                         HostFrame(plane_frame(camera, size, slanted), camera), small_scene());
    }
}

TEST(Frames, OfBackgroundOnly) {
    HostFrame frame(plane_frame(test_camera(), {13, 7}, slanted), test_camera());
    frame.add("depth", 1e10f);
    const Pixels got = evaluate_on(frame, small_scene());
    for (std::size_t i = 0; i < frame.count(); ++i) {
        EXPECT_EQ(got.at("marked")[i], Marked::invalid);
        for (const char* name : {"normal.x", "normal.y", "normal.z"})
            EXPECT_EQ(got.at(name)[i], frame.pixels.at(name)[i]);
        for (const char* name : {"surface_gradient.x", "dp_dx.y", "dp_dy.z"}) EXPECT_EQ(got.at(name)[i], 0);
    }
}

TEST(Frames, WithBrokenPixels) {
    constexpr unsigned seed = 7;
    fmt::print("seed {}\n", seed);
    std::mt19937 random(seed);
    HostFrame frame(plane_frame(test_camera(), {61, 17}, slanted), test_camera());
    const float broken[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e10f, 1e-42f, 3e38f};
    for (const char* name : {"normal.x", "normal.y", "normal.z", "depth", "uv.u", "uv.v"})
        for (const float value : broken)
            for (int k = 0; k < 3; ++k)
                // Kernels take a denormal depth as invalid on every device, since some flush it to 0.
                if (std::string(name) != "depth" || value == 0 || std::abs(value) > 1e-38f)
                    frame.pixels.at(name)[random() % frame.count()] = value;
    for (int k = 0; k < 20; ++k) {  // normals of zero, and normals that face away
        const std::size_t i = random() % frame.count();
        for (const char* name : {"normal.x", "normal.y", "normal.z"}) frame.pixels.at(name)[i] *= k < 10 ? 0.0f : -3.0f;
    }
    const Scene scene = small_scene();
    const Pixels got = evaluate_on(frame, scene);
    const Truth truth(frame, scene);
    for (const auto& [name, values] : got)
        for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << name;
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const int marked = static_cast<int>(got.at("marked")[i]);
        EXPECT_EQ(marked & ~Marked::overflow, truth.pixels[i].marked) << i;
        if (marked == Marked::invalid || (marked & Marked::overflow) != 0) continue;
        errors.push_back(angle_degrees(vec_at(got, "normal", i), truth.pixels[i].normal));
    }
    const Spread spread(std::move(errors));
    print("broken pixels among sound ones", spread, "degrees");
    EXPECT_EQ(spread.non_finite, 0u);
    EXPECT_LE(spread.p99, 1e-2);
}

TEST(Frames, FromPositionsInsteadOfDepth) {
    HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted), test_camera());
    frame.remove("depth");
    expect_agreement("positions", frame, small_scene());
}

TEST(Frames, FromDistancesAlongTheRay) {
    HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted), test_camera());
    const CameraRays<double> rays(frame.frame.camera, frame.frame.size);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        float& depth = frame.pixels.at("depth")[i];
        depth = static_cast<float>(length(rays.at_depth(double(i % 31) + 0.5, double(i / 31) + 0.5, depth)));
    }
    frame.frame.ray_depth = true;
    expect_agreement("ray depth", frame, small_scene());
}

TEST(Frames, UnderOtherCameras) {
    expect_agreement(
        "shifted pinhole",
        HostFrame(plane_frame(reference::shifted_camera(), {31, 20}, slanted), reference::shifted_camera()),
        small_scene());
    expect_agreement("orthographic",
                     HostFrame(plane_frame(orthographic_camera(), {31, 20}, slanted), orthographic_camera()),
                     small_scene());
    HostFrame tilted(plane_frame(tilted_camera(), {31, 20}, slanted), tilted_camera());
    tilted.remove("depth");
    expect_agreement("general projection, positions", tilted, small_scene());
}

TEST(Frames, UvDerivativesOfPlanesAreTakenAsTheyAre) {
    for (const bool tangents : {false, true}) {
        HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted), test_camera());
        if (tangents) {  // uv = (x, y) / 4
            for (const char* name : {"dp_du.x", "dp_dv.y"}) frame.add(name, 4);
            for (const char* name : {"dp_du.y", "dp_dv.x"}) frame.add(name);
            frame.add("dp_du.z", static_cast<float>(-4 * slanted.x / slanted.z));
            frame.add("dp_dv.z", static_cast<float>(-4 * slanted.y / slanted.z));
        } else {
            for (const char* name : {"duv_dx.u", "duv_dx.v", "duv_dy.u", "duv_dy.v"}) frame.add(name);
            const Truth truth(frame, {});
            for (std::size_t i = 0; i < frame.count(); ++i) {
                const auto& d = truth.pixels[i].base;
                frame.pixels.at("duv_dx.u")[i] = static_cast<float>(d.dp_dx.x / 4);
                frame.pixels.at("duv_dx.v")[i] = static_cast<float>(d.dp_dx.y / 4);
                frame.pixels.at("duv_dy.u")[i] = static_cast<float>(d.dp_dy.x / 4);
                frame.pixels.at("duv_dy.v")[i] = static_cast<float>(d.dp_dy.y / 4);
            }
        }
        expect_agreement(tangents ? "dp_du, dp_dv" : "duv_dx, duv_dy", frame, small_scene());
        EXPECT_FALSE(evaluate(device(), small_scene(), frame.frame).needs_neighbours());
    }
}

/// Tangents as a renderer interpolates them: neither unit nor perpendicular to the normal, which is not unit either.
HostFrame frame_with_tangents() {
    HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted * 0.8), test_camera());
    for (const char* name : {"tangent.x", "tangent.y", "tangent.z", "tangent_sign"}) frame.add(name);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const double turn = 0.02 * static_cast<double>(i);
        frame.pixels.at("tangent.x")[i] = static_cast<float>(0.9 * std::cos(turn));
        frame.pixels.at("tangent.y")[i] = static_cast<float>(0.9 * std::sin(turn));
        frame.pixels.at("tangent.z")[i] = 0.1f;
        frame.pixels.at("tangent_sign")[i] = i % 3 == 0 ? -1.0f : 1.0f;
    }
    frame.pixels.at("tangent.y")[44] = NAN;
    frame.pixels.at("tangent_sign")[45] = INFINITY;
    for (const char* name : {"tangent.x", "tangent.y", "tangent.z"}) frame.pixels.at(name)[46] = 0;
    return frame;
}

TEST(Frames, TangentsOfTheRenderer) {
    HostFrame frame = frame_with_tangents();
    Scene scene = small_scene();
    auto& weave = std::get<NormalMapLayer>(scene.layers[0].bump);
    weave.uv.scale = {2, -3};
    expect_agreement("tangents, found", frame, scene);
    weave.tangents = TangentSource::planes;
    expect_agreement("tangents, asked for", frame, scene);
    EXPECT_EQ(evaluate_on(frame, scene).at("marked")[44], Marked::no_uv_derivative);
    EXPECT_EQ(evaluate_on(frame, scene).at("marked")[46], 0);
    Scene staged = scene;
    Layer resolve;
    resolve.name = "resolve", resolve.bump = ResolveLayer{};
    staged.layers = {staged.layers[2], resolve, staged.layers[0], staged.layers[1]};
    const Truth truth(frame, staged);
    expect_within("tangents after a resolve", normal_error(evaluate_on(frame, staged), truth), {1e-4, 1e-3, 3e-3},
                  "degrees");
    weave.tangents = TangentSource::derived;
    expect_agreement("tangents, ignored", frame, scene);
}

TEST(Frames, BitangentsOfTheRenderer) {
    HostFrame frame = frame_with_tangents();
    frame.remove("tangent_sign");
    for (const char axis : {'x', 'y', 'z'}) frame.add(std::string("bitangent.") + axis, axis == 'y' ? 0.7f : 0.2f);
    Scene scene = small_scene();
    std::get<NormalMapLayer>(scene.layers[0].bump).tangents = TangentSource::planes;
    expect_agreement("bitangents", frame, scene);
    frame.remove("bitangent.x");
    try {
        evaluate(device(), scene, frame.frame);
        ADD_FAILURE() << "no bitangent, no sign";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("layer \"weave\" (without tangent_sign) needs bitangent.x"),
                  std::string::npos)
            << error.what();
    }
}

TEST(Frames, ObjectNormalsOfATurnedScaledAndMirroredObject) {
    const HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted), test_camera());
    Scene scene = small_scene();
    ObjectNormalLayer rope;
    rope.texture.file = data_folder / "textures/rope_object_normal.png";
    rope.texture.wrap = Wrap::clamp;
    rope.channels = {{{0, 1, 0}, {0, 0, -1}, {1, 0, 0}}};
    rope.object_to_world = {{{0.5, 1, 0.2}, {-2, 0.3, 0}, {0.1, 0, -3}}};
    scene.layers[0].bump = rope, scene.layers[0].scale = 0.3;
    const Truth truth(frame,
                      scene);  // only angles are compared, as gradients are huge where normals are nearly tangent
    expect_within("object normals", normal_error(evaluate_on(frame, scene), truth), {1e-4, 1e-3, 3e-3}, "degrees");
    std::get<ObjectNormalLayer>(scene.layers[0].bump).object_to_world[2] = {0, 0, 0};
    EXPECT_THROW(evaluate(device(), scene, frame.frame), Error);
}

TEST(Frames, DerivativeMapsOfEveryScale) {
    const HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted), test_camera());
    for (const bool automatic : {false, true})
        for (const SlopeUnit unit : {SlopeUnit::texel, SlopeUnit::texture}) {
            Scene scene = small_scene();
            DerivativeMapLayer rock;
            rock.texture.file = data_folder / "textures/rock_slopes.png";
            rock.texture.unit = unit, rock.texture.y_down = automatic;
            rock.auto_scale = automatic;
            rock.uv.scale = {3, -1};
            scene.layers[0].bump = rock, scene.layers[0].scale = automatic ? 0.5 : 0.01;
            expect_agreement("derivative maps", frame, scene);
        }
}

TEST(Frames, DecalsOfSlopesAndTheirRegions) {
    const HostFrame frame(plane_frame(test_camera(), {31, 20}, slanted), test_camera());
    const reference::Frame<double> decoder({}, frame.frame.size, frame.frame.camera, frame.planes());
    const V at = decoder.decode(frame.count() / 2).position + decoder.rays().eye();
    std::vector<Projector> rows(2);
    for (Projector& row : rows) {
        row.center = {at.x, at.y, at.z};
        row.half_size = {3, 2, 4};
        row.two_sided = true;
        row.angle_fade = {0, 0.1};
    }
    rows[1].region = {0.25, 0.5, 0.75, 1};
    rows[1].shape = ProjectorShape::cone;
    rows[1].scale = 0.3;
    for (const Encoding encoding : {Encoding::automatic, Encoding::sign}) {
        DecalsLayer wear;
        wear.textures = {{.file = data_folder / "textures/rock_slopes.png", .content = Content::slope}};
        wear.textures[0].encoding = encoding;
        wear.textures[0].y_down = encoding == Encoding::sign;
        wear.rows = std::make_shared<const std::vector<Projector>>(rows);
        Scene scene = small_scene();
        scene.layers[0].bump = wear;
        expect_agreement("decals of slopes", frame, scene);
        scene.layers.resize(1);
        const Pixels alone = evaluate_on(frame, scene);
        std::size_t bumped = 0;
        for (std::size_t i = 0; i < frame.count(); ++i)
            bumped += length(vec_at(alone, "surface_gradient", i)) > 1e-3 ? 1 : 0;
        EXPECT_GT(bumped, 50u);
    }
}

TEST(Frames, InvertedTextureMaskIsZeroWithoutUvDerivative) {
    HostFrame frame(plane_frame(test_camera(), {9, 9}, slanted), test_camera());
    frame.add("object");
    frame.pixels.at("object")[40] = 1;  // the pixel in the middle is an object of its own, without neighbours
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.3, 0, 0}};
    scene.layers[0].mask.texture = MaskTexture{data_folder / "textures/seal_height.png", {}};
    scene.layers[0].mask.invert = true;
    scene.output.surface_gradient = scene.output.marked = true;
    const Truth truth(frame, scene);
    const Pixels got = evaluate_on(frame, scene);
    EXPECT_EQ(marked_differences(got, truth), 0u);
    EXPECT_EQ(got.at("marked")[40], Marked::no_uv_derivative);
    EXPECT_EQ(length(vec_at(got, "surface_gradient", 40)), 0);
    expect_within("inverted texture mask", normal_error(got, truth), {1e-4, 1e-3, 1e-3}, "degrees");
}

}  // namespace
}  // namespace wrinkle::test
