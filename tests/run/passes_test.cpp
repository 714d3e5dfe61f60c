// The other passes than evaluate; the caller's own queue and buffers; what the library refuses.
#include <algorithm>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using reference::CameraRays;
using reference::orthographic_camera;
using reference::plane_frame;
using reference::test_camera;

const V slanted = normalize(V{0.1, -0.2, 1});

HostFrame plane(Size size = {37, 23}) { return {plane_frame(test_camera(), size, slanted), test_camera()}; }

template <class Work>
std::string refusal(Work work) {
    try {
        work();
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

/// The layers of data/scenes/decals.toml without angle fade and without mips, so that nothing depends on a normal.
Scene open_decals() {
    Scene scene = data_scene("decals");
    scene.lighting.relight = Relight::off;
    scene.output = {.surface_gradient = true};
    for (Layer& layer : scene.layers) {
        std::get<DecalLayer>(layer.bump).angle_fade = {-1, -1};
        layer.footprint = false;
    }
    return scene;
}

TEST(AccumulateDecals, ProjectedLaterIsWhatEvaluateGives) {
    const HostFrame frame = small_frame();
    Scene scene = open_decals();
    Pass accumulate = accumulate_decals(device(), scene.layers, frame.frame);
    EXPECT_EQ(accumulate.inputs(), std::vector<std::string>{"depth"});
    const Pixels volume = run(accumulate, frame);
    const Pixels evaluated = evaluate_on(frame, scene);
    const Truth truth(frame, scene);
    double largest = 0, gap = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (!truth.pixels[i].valid) continue;
        const V n = truth.pixels[i].base_normal, dh_dp = vec_at(volume, "volume_gradient", i);
        const V g = dh_dp - n * dot(n, dh_dp);
        largest = std::max(largest, length(g));
        gap = std::max(gap, length(g - vec_at(evaluated, "surface_gradient", i)));
    }
    fmt::print("decals, projected later: largest slope {:.3g}, off by {:.2e}\n", largest, gap);
    EXPECT_GT(largest, 0.1);
    EXPECT_LE(gap, 1e-5 * largest);

    std::ranges::reverse(scene.layers);
    Pass reversed = accumulate_decals(device(), scene.layers, frame.frame);
    EXPECT_LE(largest_difference(volume, run(reversed, frame)), 1e-6 * largest);
}

TEST(AccumulateDecals, WithFootprintsDiffersOnlyByTheFootprint) {
    const HostFrame frame = small_frame();
    Scene scene = open_decals();
    for (Layer& layer : scene.layers) layer.footprint = true;
    Pass pass = accumulate_decals(device(), scene.layers, frame.frame);
    for (const auto& [name, values] : run(pass, frame))
        for (const float value : values) ASSERT_TRUE(std::isfinite(value)) << name;
    scene.layers[0].bump = NoiseLayer{};
    expect_refused(refusal([&] { accumulate_decals(device(), scene.layers, frame.frame); }),
                   {scene.layers[0].name, "no decal"});
}

TEST(ScreenDerivatives, AreTheStepsToTheNeighboursOnAPlane) {
    for (const Camera& camera : {test_camera(), orthographic_camera()}) {
        const HostFrame frame(plane_frame(camera, {37, 23}, slanted), camera);
        const Size size = frame.frame.size;
        Pass pass = screen_derivatives(device(), frame.frame);
        const Pixels got = run(pass, frame);
        // The derivative at a pixel is compared with the central difference of true positions, which differs from it
        // only to second order.
        const CameraRays<double> rays(camera, size);
        const auto point = [&](double x, double y) {
            const V a = rays.at_depth(x, y, 1), d = rays.at_depth(x, y, 2) - a;
            return a - d * (dot(slanted, a + rays.eye()) / dot(slanted, d));
        };
        for (std::uint32_t y = 0; y < size.height; ++y)
            for (std::uint32_t x = 0; x < size.width; ++x) {
                const std::size_t i = std::size_t{y} * size.width + x;
                const double cx = x + 0.5, cy = y + 0.5, h = 1e-3;
                const V right = (point(cx + h, cy) - point(cx - h, cy)) / (2 * h);
                const V down = (point(cx, cy + h) - point(cx, cy - h)) / (2 * h);
                EXPECT_LE(length(vec_at(got, "dp_dx", i) - right), 2e-6 * length(right)) << x << ", " << y;
                EXPECT_LE(length(vec_at(got, "dp_dy", i) - down), 2e-6 * length(down)) << x << ", " << y;
            }
    }
}

TEST(Enqueue, WorksOnTheCallersQueueAndBuffersAfterTheCallersEvents) {
    const cl::Device raw = device().device;
    const cl::Context context(raw);
    const cl::CommandQueue queue(context, raw);
    const Device adopted = Device::adopt(context, queue);
    EXPECT_EQ(adopted.info.name, device().info.name);

    const HostFrame frame = plane();
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.3, 0.1, 0}};
    Pass pass = evaluate(adopted, scene, frame.frame);
    const std::size_t bytes = padded(frame.count()) * sizeof(float);
    const cl::UserEvent start(context);
    const std::vector<cl::Event> started{start};
    DevicePlanes in, out;
    std::vector<cl::Event> uploaded;
    for (const std::string& name : pass.inputs()) {
        in[name] = cl::Buffer(context, CL_MEM_READ_ONLY, bytes);
        uploaded.emplace_back();
        queue.enqueueWriteBuffer(in[name], CL_FALSE, 0, frame.count() * sizeof(float), frame.pixels.at(name).data(),
                                 &started, &uploaded.back());
    }
    for (const std::string& name : pass.outputs()) out[name] = cl::Buffer(context, CL_MEM_WRITE_ONLY, bytes);
    const cl::Event done = pass.enqueue(in, out, uploaded);
    EXPECT_NE(done.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(), CL_COMPLETE) << "the inputs are not there yet";
    cl::UserEvent(start).setStatus(CL_COMPLETE);
    done.wait();
    Pixels got;
    for (const std::string& name : pass.outputs()) {
        got[name].resize(frame.count());
        queue.enqueueReadBuffer(out[name], CL_TRUE, 0, frame.count() * sizeof(float), got[name].data());
    }
    EXPECT_EQ(largest_difference(got, evaluate_on(frame, scene)), 0);
}

TEST(Refused, PlanesMissingOrShort) {
    const HostFrame frame = plane();
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.3, 0.1, 0}};
    Pass pass = evaluate(device(), scene, frame.frame);
    Pixels out{{"normal.x", {}}, {"normal.y", {}}, {"normal.z", {}}};
    HostOutputs spans;
    for (auto& [name, values] : out) {
        values.resize(frame.count());
        spans[name] = values;
    }
    HostPlanes in = frame.planes();
    EXPECT_NO_THROW(pass.run(in, spans));

    in.erase("depth");
    expect_refused(refusal([&] { pass.run(in, spans); }), {"input", "depth"});
    in["depth"] = std::span(frame.pixels.at("depth")).first(10);
    expect_refused(refusal([&] { pass.run(in, spans); }), {"depth", "10", "851"});
    in = frame.planes();
    spans.erase("normal.y");
    expect_refused(refusal([&] { pass.run(in, spans); }), {"output", "normal.y"});
    std::vector<double> wide(frame.count());
    expect_refused(refusal([&] {
                       pass.run(in, HostDoubles{{"normal.x", wide}, {"normal.y", wide}, {"normal.z", wide}});
                   }),
                   {"double", "fp64"});

    DevicePlanes small, written;
    for (const char* name : {"depth", "normal.x", "normal.y", "normal.z"})
        for (DevicePlanes* planes : {&small, &written})
            (*planes)[name] = cl::Buffer(device().context, CL_MEM_READ_WRITE, 64);
    expect_refused(refusal([&] { pass.enqueue(small, written); }), {"depth", "64 bytes"});
    EXPECT_NE(refusal([&] { pass.enqueue(small, written, Rows{20, 4, 0, 0}); }).find("20 to 24"), std::string::npos);
}

TEST(Refused, CamerasAndFrames) {
    const HostFrame frame = plane();
    Scene scene;
    scene.filter.taps = 1;
    Pass pass = evaluate(device(), scene, frame.frame);
    EXPECT_NO_THROW(pass.set_camera(reference::shifted_camera()));
    expect_refused(refusal([&] { pass.set_camera(orthographic_camera()); }), {"kind"});

    Frame empty = frame.frame;
    empty.size = {0, 4};
    expect_refused(refusal([&] { evaluate(device(), scene, empty); }), {"no pixels"});
    Frame bare = frame.frame;
    bare.planes = {"depth"};
    expect_refused(refusal([&] { evaluate(device(), scene, bare); }), {"normal.x", "depth"});
    scene.layers.resize(1);
    scene.layers[0].name = "endless";
    scene.layers[0].scale = std::numeric_limits<double>::infinity();
    scene.layers[0].bump = ConstantLayer{{0.3, 0.1, 0}};
    expect_refused(refusal([&] { evaluate(device(), scene, frame.frame); }), {"endless", "scale"});
}

TEST(Refused, BandsWithoutTheRowsTheyNeed) {
    const HostFrame frame = plane();
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    NormalMapLayer weave;
    weave.texture.file = data_folder / "textures/weave_normal.png";
    scene.layers[0].bump = weave;
    Pass pass = evaluate(device(), scene, frame.frame);
    ASSERT_TRUE(pass.needs_neighbours());
    const auto buffers = [&](const std::vector<std::string>& names) {
        DevicePlanes planes;
        for (const std::string& name : names)
            planes[name] = cl::Buffer(device().context, CL_MEM_READ_WRITE, padded(frame.count() + 64) * sizeof(float));
        return planes;
    };
    const DevicePlanes in = buffers(pass.inputs()), out = buffers(pass.outputs());
    expect_refused(refusal([&] { pass.enqueue(in, out, Rows{4, 4, 0, 1}); }), {"neighbours"});
    EXPECT_NO_THROW(pass.enqueue(in, out, Rows{4, 4, 1, 1}).wait());
    EXPECT_NO_THROW(pass.enqueue(in, out, Rows{0, 4, 0, 1}).wait());
}

}  // namespace
}  // namespace wrinkle::test
