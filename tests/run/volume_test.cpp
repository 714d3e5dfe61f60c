// Volumes on the golden-ratio surface, whose normals, derivatives and gradients are known exactly.
#include "tests/reference/volume.h"
#include "tests/run/run_frame.h"
#include "tests/run/temp_volume.h"
#include "tools/bake.h"
#include "wrinkle/functions.h"

namespace wrinkle::test {
namespace {

const Camera& golden_camera() {
    static const Camera camera = Camera::look_at({3, -13, 6}, {0, 0, 0}, {0, 0, 1}, 0.75, 4.0 / 3);
    return camera;
}

HostFrame golden_frame(Size size = {128, 96}) {
    HostFrame frame;
    frame.frame.size = size, frame.frame.camera = golden_camera();
    for (auto& [name, values] : bake_golden_rows(device(), golden_camera(), size, 0, size.height))
        frame.add(name) = std::move(values);
    return frame;
}

Scene scene_of(VolumeLayer volume, double scale = 1) {
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].name = "volume";
    scene.layers[0].bump = std::move(volume);
    scene.layers[0].scale = scale;
    scene.layers[0].footprint = false;  // the formulas; tests/run/area_volumes_test.cpp has the filter
    scene.output = {.surface_gradient = true, .dp_dx = true, .dp_dy = true};
    return scene;
}

bool hit(const HostFrame& frame, std::size_t i) { return frame.pixels.at("depth")[i] < 1e9f; }

TEST(GoldenFrame, LiesOnTheSurfaceWithItsNormals) {
    const HostFrame frame = golden_frame();
    std::size_t hits = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (!hit(frame, i)) continue;
        ++hits;
        const V p = vec_at(frame.pixels, "position", i), n = vec_at(frame.pixels, "normal", i);
        const auto f = reference::golden_ratio(p);
        EXPECT_NEAR(f.value, 0, 1e-5);
        EXPECT_LT(angle_degrees(n, f.gradient), 1e-4);
    }
    EXPECT_GT(hits, frame.count() / 4);
    EXPECT_LT(hits, frame.count());
}

/// Where the surface is flat enough, screen derivatives agree with differences of neighbouring pixels.
TEST(GoldenFrame, ScreenDerivativesAreThoseOfTheSurface) {
    const HostFrame frame = golden_frame({640, 480});
    Pass pass = screen_derivatives(device(), frame.frame);
    const Pixels got = run(pass, frame);
    const reference::CameraRays<double> rays(golden_camera(), frame.frame.size);
    std::vector<double> exact, neighbours;
    const std::size_t width = frame.frame.size.width;
    for (std::size_t i = 1; i + 1 < frame.count(); ++i) {
        if (!hit(frame, i)) continue;
        const double x = double(i % width) + 0.5, y = double(i / width) + 0.5;
        const V p = rays.at_depth(x, y, frame.pixels.at("depth")[i]), world = p + rays.eye();
        const V n = normalize(reference::golden_ratio(world).gradient);
        if (std::abs(dot(n, normalize(p))) < 0.1) continue;
        const V dp_dx = vec_at(got, "dp_dx", i), want = rays.derivative(p, n, x, y).dp_dx;
        exact.push_back(length(dp_dx - want) / length(want));
        if (i % width == 0 || i % width == width - 1 || !hit(frame, i - 1) || !hit(frame, i + 1)) continue;
        const V step = (rays.at_depth(x + 1, y, frame.pixels.at("depth")[i + 1]) -
                        rays.at_depth(x - 1, y, frame.pixels.at("depth")[i - 1])) /
                       2.0;
        neighbours.push_back(length(dp_dx - step) / length(dp_dx));
    }
    expect_within("golden frame: dp_dx", Spread(exact), {6e-7, 1e-5, 5e-5}, "relative");
    const Spread found(neighbours);
    print("golden frame: dp_dx against neighbours", found, "relative");
    EXPECT_LT(found.median, 0.01);  // what curvature makes of the differences
}

/// The gradient of the surface's own level set is along its normal, so it bumps nothing.
TEST(VolumeLayer, OfTheSurfaceItselfHasNoSurfaceGradient) {
    const HostFrame frame = golden_frame();
    const TempVolume file(bake_volume(device(), BakedVolume::golden, 128));
    for (const VolumeFilter filter : {VolumeFilter::linear, VolumeFilter::smooth}) {
        const Pixels got = evaluate_on(frame, scene_of({.file = file.file, .filter = filter}));
        std::vector<double> degrees;
        for (std::size_t i = 0; i < frame.count(); ++i)
            if (hit(frame, i))
                degrees.push_back(angle_degrees(vec_at(got, "normal", i), vec_at(frame.pixels, "normal", i)));
        const Spread spread(degrees);
        print(filter == VolumeFilter::linear ? "level set, linear: turned" : "level set, smooth: turned", spread,
              "degrees");
        EXPECT_LT(spread.median, filter == VolumeFilter::linear ? 3 : 0.3);  // degrees, with 128^3 voxels
    }
}

/// A grid of the function's gradients, placed elsewhere by a matrix, against the exact gradient.
TEST(VolumeLayer, OfVectorsIsTheGradient) {
    const HostFrame frame = golden_frame();
    const TempVolume file(bake_volume(device(), BakedVolume::golden_gradient, 96));
    const Pixels got = evaluate_on(frame, scene_of({.file = file.file}, 0.1));
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.count(); ++i)
        if (hit(frame, i))  // along the normal, but for the coarseness of the grid
            errors.push_back(length(vec_at(got, "surface_gradient", i)));
    expect_within("vector grid", Spread(errors), {6e-4, 2e-3, 3e-3}, "of 0.3 to 0.6");
}

/// value = a . index, placed by a sheared, mirrored matrix: the gradient is the inverse transpose times a.
TEST(VolumeLayer, FollowsItsTransformByTheInverseTranspose) {
    DenseVolume linear;
    linear.first = {-40, -40, -40}, linear.size = {80, 80, 80};
    for (int i = 0; i < 80 * 80 * 80; ++i)
        linear.values.push_back(0.03f * static_cast<float>(i % 80) - 0.02f * static_cast<float>(i / 80 % 80) +
                                0.01f * static_cast<float>(i / 6400));
    linear.world_from_index = {{{0.3, 0.05, 0, 0.1}, {0, -0.4, 0.1, 0}, {0.02, 0, 0.35, 0}, {0, 0, 0, 1}}};
    const TempVolume file(linear);
    VolumeLayer layer{.file = file.file};
    layer.transform = {{{0, -1.25, 0, 0.5}, {1, 0, 0.2, 0}, {0, 0, 1, 0.25}, {0, 0, 0, 1}}};
    const Mat4 back = inverse(multiply(layer.transform, linear.world_from_index));
    const V want{0.03 * back[0][0] - 0.02 * back[1][0] + 0.01 * back[2][0],
                 0.03 * back[0][1] - 0.02 * back[1][1] + 0.01 * back[2][1],
                 0.03 * back[0][2] - 0.02 * back[1][2] + 0.01 * back[2][2]};
    const HostFrame frame = golden_frame();
    for (const VolumeFilter filter : {VolumeFilter::linear, VolumeFilter::smooth}) {
        layer.filter = filter;
        const Pixels got = evaluate_on(frame, scene_of(layer));
        std::vector<double> errors;
        for (std::size_t i = 0; i < frame.count(); ++i) {
            if (!hit(frame, i)) continue;
            const V n = vec_at(frame.pixels, "normal", i), g = want - n * dot(n, want);
            errors.push_back(length(vec_at(got, "surface_gradient", i) - g) / length(want));
        }
        expect_within("linear values, sheared", Spread(errors), {3e-6, 1e-5, 2e-5}, "relative");
    }
}

TEST(VolumeLayer, ThatIsTooLargeForTheDeviceIsRefusedWithTheSizes) {
    const HostFrame frame = golden_frame({16, 16});
    const TempVolume file(bake_volume(device(), BakedVolume::noise, 32));
    Device small = device();
    small.info.largest_buffer = 100 << 10;
    const auto expect_refused = [&](const auto& work) {
        try {
            work();
            ADD_FAILURE() << "nothing was refused";
        } catch (const Error& error) {
            for (const char* part : {"textures and volumes take 0.", "allows 0.1 MiB", "crop or resample grids"})
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " in " << error.what();
        }
    };
    expect_refused([&] { evaluate(small, scene_of({.file = file.file}), frame.frame); });
    const std::vector<float> p(1);
    std::vector<float> value(1);
    expect_refused([&] {
        evaluate_function(small, function("volume_trilinear"), {{"p.x", p}, {"p.y", p}, {"p.z", p}}, {{"value", value}},
                          {.settings = {{"volume", file.file}}});
    });
    EXPECT_NO_THROW(evaluate(device(), scene_of({.file = file.file}), frame.frame));
}

TEST(VolumeLayer, RefusesWhatItCannotUse) {
    const HostFrame frame = golden_frame({16, 16});
    const auto refusal = [&](const VolumeLayer& layer) -> std::string {
        try {
            evaluate_on(frame, scene_of(layer));
        } catch (const Error& error) { return error.what(); }
        return "nothing was refused";
    };
    const TempVolume file(bake_volume(device(), BakedVolume::golden_gradient, 16));
    EXPECT_NE(refusal({.file = "no.vdb"}).find("there is no file"), std::string::npos);
    EXPECT_NE(refusal({.file = file.file, .grid = "x"}).find("grids: \"gradient\" (vec3s)"), std::string::npos);
    EXPECT_NE(refusal({.file = file.file, .remap = Remap::wave}).find("holds vectors"), std::string::npos);
    EXPECT_NE(refusal({.file = file.file, .filter = VolumeFilter::smooth}).find("holds vectors"), std::string::npos);
}

}  // namespace
}  // namespace wrinkle::test
