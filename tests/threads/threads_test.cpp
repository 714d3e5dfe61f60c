// What the public headers say that threads may share. Under ThreadSanitizer: ./bootstrap test tsan
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <functional>
#include <latch>
#include <thread>

#include "tests/device/test_device.h"
#include "tests/io/files.h"
#include "tools/render.h"
#include "wrinkle/error.h"
#include "wrinkle/functions.h"
#include "wrinkle/gbuffer.h"
#include "wrinkle/passes.h"

namespace wrinkle::test {
namespace {

namespace fs = std::filesystem;

const fs::path data = fs::path(WRINKLE_SOURCE_DIR) / "data";
constexpr int kRounds = 3;

/// Runs the work on a thread for each number, all of them at once.
void on_threads(std::size_t threads, const std::function<void(std::size_t)>& work) {
    std::latch start(static_cast<std::ptrdiff_t>(threads));
    std::vector<std::jthread> running;
    for (std::size_t i = 0; i < threads; ++i)
        running.emplace_back([&, i] {
            start.arrive_and_wait();
            for (int round = 0; round < kRounds; ++round) work(i);
        });
}

/// The ground seen from above, with a scene that bumps it.
struct Ground {
    Scene scene;
    Frame frame{{67, 43},
                Camera::look_at({0, -1, 3}, {0, 0, 0}, {0, 0, 1}, 0.8, 67.0 / 43),
                {"depth", "normal.x", "normal.y", "normal.z"}};
    std::vector<float> depth = std::vector<float>(67 * 43, 3), zero = std::vector<float>(67 * 43, 0),
                       one = std::vector<float>(67 * 43, 1);

    explicit Ground(double frequency) {
        Layer& noise = scene.layers.emplace_back();
        noise.name = "noise";
        noise.bump = NoiseLayer{.frequency = frequency, .octaves = 2};
        noise.scale = 0.1;
        Layer& map = scene.layers.emplace_back();
        map.name = "map";
        map.bump = HeightMapLayer{.texture = {.file = data / "textures/cobbles_height.png"},
                                  .uv = {.source = UvSource::planar}};
        map.scale = 0.02;
        Layer& decals = scene.layers.emplace_back();
        decals.name = "decals";
        DecalsLayer table;
        table.textures = {{.file = data / "textures/seal_height.png"}};
        table.rows = std::make_shared<const std::vector<Projector>>(
            std::vector<Projector>(3, {.center = {0, 0, 0}, .half_size = {0.5, 0.5, 0.5}}));
        decals.bump = table;
    }

    std::vector<float> normals(Pass& pass) const {
        std::vector<float> out(3 * depth.size());
        HostOutputs planes;
        for (std::size_t k = 0; k < 3; ++k)
            planes[std::string("normal.") + "xyz"[k]] = std::span(out).subspan(k * depth.size(), depth.size());
        pass.run({{"depth", depth}, {"normal.x", zero}, {"normal.y", zero}, {"normal.z", one}}, planes);
        return out;
    }

    std::vector<float> normals(const Device& device) const {
        Pass pass = evaluate(device, scene, frame);
        return normals(pass);
    }
};

TEST(Threads, EachWithItsPassOnOneDevice) {
    const Ground coarse(3), fine(9);
    const Ground* grounds[] = {&coarse, &fine};
    const std::vector<float> want[] = {coarse.normals(test_device()), fine.normals(test_device())};
    Pass passes[] = {evaluate(test_device(), coarse.scene, coarse.frame),
                     evaluate(test_device(), fine.scene, fine.frame)};
    on_threads(2, [&](std::size_t i) { EXPECT_EQ(grounds[i]->normals(passes[i]), want[i]); });
}

TEST(Threads, MakePassesOnCopiesOfADevice) {
    const Ground ground(5);
    const std::vector<float> want = ground.normals(test_device());
    on_threads(2, [&](std::size_t) {
        const Device copy = test_device();
        EXPECT_EQ(ground.normals(copy), want);
    });
}

TEST(Threads, EnqueueOnOneQueue) {
    const Ground ground(4);
    const std::size_t pixels = ground.depth.size(), bytes = padded(pixels) * sizeof(float);
    const std::vector<float> want = ground.normals(test_device());
    on_threads(2, [&](std::size_t) {
        const Device& device = test_device();
        Pass pass = evaluate(device, ground.scene, ground.frame);
        DevicePlanes in, out;
        const std::pair<const char*, const std::vector<float>*> given[] = {{"depth", &ground.depth},
                                                                           {"normal.x", &ground.zero},
                                                                           {"normal.y", &ground.zero},
                                                                           {"normal.z", &ground.one}};
        std::vector<cl::Event> uploaded;
        for (const auto& [name, values] : given) {
            in[name] = cl::Buffer(device.context, CL_MEM_READ_ONLY, bytes);
            device.queue.enqueueWriteBuffer(in[name], CL_FALSE, 0, pixels * sizeof(float), values->data(), nullptr,
                                            &uploaded.emplace_back());
        }
        for (const std::string& name : pass.outputs()) out[name] = cl::Buffer(device.context, CL_MEM_WRITE_ONLY, bytes);
        const std::vector<cl::Event> done{pass.enqueue(in, out, uploaded)};
        std::vector<float> x(pixels);
        device.queue.enqueueReadBuffer(out["normal.x"], CL_TRUE, 0, pixels * sizeof(float), x.data(), &done);
        EXPECT_TRUE(std::ranges::equal(x, std::span(want).first(pixels)));
    });
}

TEST(Threads, EvaluateFunctions) {
    std::vector<float> x(5000), zero(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<float>(i) * 0.01f;
    const char* names[] = {"perlin_noise", "simplex_noise", "perlin_noise"};
    std::vector<std::vector<float>> got(3, std::vector<float>(x.size()));
    on_threads(3, [&](std::size_t i) {
        evaluate_function(test_device(), function(names[i]), Columns{{"p.x", x}, {"p.y", zero}, {"p.z", zero}},
                          {{"value", got[i]}});
    });
    EXPECT_EQ(got[0], got[2]);
    EXPECT_NE(got[0], got[1]);
}

TEST(Threads, ListDevicesAndTables) {
    std::atomic<std::size_t> devices = 0;
    on_threads(3, [&](std::size_t) {
        devices += list_devices().size();
        EXPECT_EQ(Device::open(test_device_name()).info.name, test_device().info.name);
        EXPECT_FALSE(functions().empty());
        EXPECT_FALSE(gbuffer_roles().empty());
    });
    EXPECT_EQ(devices, 3 * kRounds * list_devices().size());
}

TEST(Threads, LoadScenesAndTables) {
    const char* scenes[] = {"courtyard", "volume", "decal_table", "courtyard"};
    on_threads(4, [&](std::size_t i) {
        const Scene scene = load_scene(data / "scenes" / (std::string(scenes[i]) + ".toml"));
        EXPECT_FALSE(scene.layers.empty());
        EXPECT_THROW(load_scene("missing.toml"), Error);
    });
}

/// The next frame is opened, and looked at, while one is evaluated and the files of another are written.
TEST(Threads, OpenFramesAhead) {
    const TempFolder folder;
    for (int frame = 1; frame <= 4; ++frame)
        write_exr(folder / ("frame." + std::to_string(frame) + ".exr"), 67, 43, {"N.X", "N.Y", "N.Z", "Z"},
                  [](int channel, int, int) { return channel == 2   ? 1.0f
                                                     : channel == 3 ? 3.0f
                                                                    : 0.0f; });
    Scene scene = Ground(7).scene;
    scene.gbuffer.file = folder / "frame.#.exr";
    scene.camera.look_at = CameraSource::LookAt{.eye = {0, -1, 3}, .target = {0, 0, 0}, .fov_y = 0.8};
    RenderOptions options;
    options.directory = folder / "out";
    options.frames = {1, 2, 3, 4};
    options.device = test_device_name();
    const RenderReport report = render(scene, options);
    EXPECT_EQ(report.frames, 4);
    EXPECT_TRUE(report.failed.empty());
}

TEST(Threads, ReadOneScene) {
    const Ground ground(7);
    const std::vector<float> want = ground.normals(test_device());
    on_threads(2, [&](std::size_t) {
        Scene copy = ground.scene;
        copy.layers.front().scale = 0.2;
        EXPECT_NE(ground.scene.layers.front().scale, copy.layers.front().scale);
        EXPECT_EQ(ground.normals(test_device()), want);
    });
}

}  // namespace
}  // namespace wrinkle::test
