// Queues that a user may hand in: out of order, without profiling. Results are those of a queue in order, bit by bit.
#include <gtest/gtest.h>

#include <cmath>

#include "budget/error_sample.h"
#include "run/frame_run.h"
#include "tests/run/decal_frames.h"
#include "wrinkle/functions.h"

namespace wrinkle::test {
namespace {

constexpr int kRounds = 20;

Device on_queue(cl_command_queue_properties properties) {
    const cl::Context context(device().device);
    return Device::adopt(context, cl::CommandQueue(context, device().device, properties));
}

Device out_of_order() {
    if ((device().device.getInfo<CL_DEVICE_QUEUE_PROPERTIES>() & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) == 0)
        return {};
    return on_queue(CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
}

class OutOfOrder : public testing::Test {
protected:
    void SetUp() override {
        if (queue_.queue() == nullptr) GTEST_SKIP() << device().info.name << " has no queues out of order";
    }
    const Device queue_ = out_of_order();
};

/// Adds layers that hand on what they make through memory, where the pass is split.
Scene with_stages(Scene scene) {
    for (const double tilt : {0.2, -0.4}) {
        Layer& layer = scene.layers.emplace_back();
        layer.name = "tilt " + std::to_string(tilt);
        layer.bump = ConstantLayer{{tilt, 0.1, 0.3}};
        scene.layers.emplace_back().bump = ResolveLayer{};
        scene.layers.back().name = "resolve " + std::to_string(tilt);
    }
    return scene;
}

DevicePlanes buffers(const Device& on, const std::vector<std::string>& names, std::size_t pixels) {
    DevicePlanes planes;
    for (const std::string& name : names)
        planes[name] = cl::Buffer(on.context, CL_MEM_READ_WRITE, padded(pixels) * sizeof(float));
    return planes;
}

/// Uploads, evaluates and reads back bands of rows again and again, none of it waited for before all is enqueued.
std::vector<Pixels> evaluate_bands(const Device& on, Pass& pass, const HostFrame& frame, std::uint32_t rows) {
    const std::size_t width = frame.frame.size.width, height = frame.frame.size.height;
    struct Band {
        Rows rows;
        DevicePlanes in, out;
    };
    std::vector<Band> bands;
    std::vector<Pixels> results;
    std::vector<cl::Event> read;
    bands.reserve(kRounds * height), results.reserve(kRounds);
    for (int round = 0; round < kRounds; ++round) {
        Pixels& got = results.emplace_back();
        for (const std::string& name : pass.outputs()) got[name].resize(frame.count());
        for (std::uint32_t first = 0; first < height; first += rows) {
            const std::uint32_t count = std::min<std::uint32_t>(rows, static_cast<std::uint32_t>(height) - first);
            const std::uint32_t before = first > 0 ? 1 : 0, after = first + count < height ? 1 : 0;
            const std::size_t held = (before + count + after) * width;
            Band& band = bands.emplace_back(Band{{first, count, before, after},
                                                 buffers(on, pass.inputs(), held + width),
                                                 buffers(on, pass.outputs(), held)});
            std::vector<cl::Event> uploaded;
            for (const std::string& name : pass.inputs())
                on.queue.enqueueWriteBuffer(band.in[name], CL_FALSE, 0, held * sizeof(float),
                                            frame.pixels.at(name).data() + (first - before) * width, nullptr,
                                            &uploaded.emplace_back());
            const std::vector<cl::Event> done{pass.enqueue(band.in, band.out, band.rows, uploaded)};
            for (const std::string& name : pass.outputs())
                on.queue.enqueueReadBuffer(band.out[name], CL_FALSE, 0, count * width * sizeof(float),
                                           got[name].data() + first * width, &done, &read.emplace_back());
        }
    }
    cl::Event::waitForEvents(read);
    return results;
}

TEST_F(OutOfOrder, BandsThatShareListsAndScratchDoNotMix) {
    const HostFrame frame(plane_frame(test_camera(), {97, 61}, {0, 0, 1}), test_camera());
    const Scene decals = with_stages(table_scene(on_surfaces(frame, 60, 0.05, 1, 3))), stages = with_stages({});
    const struct {
        const char* what;
        const Scene& scene;
        bool split;
    } cases[] = {{"lists", decals, false}, {"lists and scratch", decals, true}, {"scratch", stages, true}};
    for (const auto& [what, scene, split] : cases) {
        Pass pass = evaluate(queue_, scene, frame.frame, {.split = split});
        Pass in_order = evaluate(device(), scene, frame.frame, {.split = split});
        const Pixels want = evaluate_bands(device(), in_order, frame, 9).front();
        for (const Pixels& got : evaluate_bands(queue_, pass, frame, 9))
            EXPECT_EQ(largest_difference(want, got), 0) << what;
    }
}

TEST_F(OutOfOrder, WholeFramesFromHostMemory) {
    const HostFrame frame = small_frame();
    for (const char* name : {"courtyard", "decal_table", "normal_map"}) {
        Scene scene = data_scene(name);
        const Pixels want = evaluate_on(frame, scene);
        Pass pass = evaluate(queue_, scene, frame.frame);
        for (int round = 0; round < kRounds; ++round) EXPECT_EQ(largest_difference(want, run(pass, frame)), 0) << name;
    }
}

TEST_F(OutOfOrder, SeveralBandsFromHostMemory) {
    const HostFrame frame(plane_frame(test_camera(), {1201, 900}, {0, 0, 1}), test_camera());
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(1);
    scene.layers[0].bump = ConstantLayer{{0.3, 0.1, 0}};
    Pass pass = evaluate(queue_, scene, frame.frame);
    EXPECT_EQ(largest_difference(evaluate_on(frame, scene), run(pass, frame)), 0);
}

/// Condition of every pixel and the sampled errors of a frame that is read, evaluated and checked in bands.
std::pair<std::vector<float>, ErrorStats> checked(const Device& on, const HostFrame& frame, const Scene& scene) {
    const GBufferReader reader(data_folder / "gbuffer/small.exr");
    Pass pass = evaluate(on, scene, frame.frame);
    ErrorSample sample(on, scene, frame.frame, {.max_error = {}, .sample = 1000});
    PhaseClock clock;
    FrameRun bands(pass.impl(), reader, clock);
    bands.check_bands(sample, frame.frame.camera);
    bands.run();

    Condition condition(on, scene, frame.frame);
    PlaneBuffers planes(on, condition.inputs(), frame.count(), sizeof(float));
    for (const std::string& name : condition.inputs())
        std::ranges::copy(frame.pixels.at(name), planes.map<float>(name, CL_MAP_WRITE));
    planes.unmap();
    return {condition.evaluate(planes, {.first = 0, .count = frame.frame.size.height}), sample.stats()};
}

TEST_F(OutOfOrder, ChecksOfAFrame) {
    if (!device().info.fp64) GTEST_SKIP() << "needs double precision";
    const HostFrame frame = small_frame();
    const Scene scene = data_scene("noise");
    const auto [want, want_stats] = checked(device(), frame, scene);
    for (int round = 0; round < 3; ++round) {
        const auto [got, stats] = checked(queue_, frame, scene);
        EXPECT_EQ(got, want);
        EXPECT_EQ(stats.max, want_stats.max);
        EXPECT_EQ(stats.median, want_stats.median);
    }
}

TEST_F(OutOfOrder, FunctionsOfColumns) {
    std::vector<float> x(3'000'000), zero(x.size()), want(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = static_cast<float>(i) * 0.001f;
    const Columns in{{"p.x", x}, {"p.y", zero}, {"p.z", zero}};
    evaluate_function(device(), function("perlin_noise"), in, {{"value", want}});
    std::vector<float> got(x.size());
    evaluate_function(queue_, function("perlin_noise"), in, {{"value", got}});
    EXPECT_EQ(got, want);
}

TEST(Queue, WithoutProfiling) {
    const HostFrame frame = small_frame();
    const Scene scene = data_scene("decal_table");
    Pass pass = evaluate(on_queue(0), scene, frame.frame);
    EXPECT_EQ(largest_difference(evaluate_on(frame, scene), run(pass, frame)), 0);
}

}  // namespace
}  // namespace wrinkle::test
