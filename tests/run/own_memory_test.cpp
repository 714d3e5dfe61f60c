// Frames through a device with a memory of its own, on one that has none: the same bits, and transfers while kernels
// run. Bands are as small as the memory that the device is said to have.
#include <dlfcn.h>

#include <array>
#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "budget/error_sample.h"
#include "plan/stored_planes.h"
#include "run/bands.h"
#include "run/frame_run.h"
#include "tests/io/files.h"
#include "tests/run/stored_frame.h"

namespace {

enum Command { up, kernel, down };

/// While it is set, every command that enqueues a kernel or a transfer is preceded by some that take time.
std::atomic<bool> slow = false;
std::atomic<int> slept = 0;                 ///< how many took their time
std::array<std::atomic<int>, 3> running{};  ///< of each command, those that take it now
std::array<std::atomic<int>, 3> beside{};   ///< of each transfer, how often it was seen to run while a kernel ran

void CL_CALLBACK take_time(void* of) {
    const Command command = *static_cast<const Command*>(of);
    ++running[command];
    for (const Command transfer : {up, down})
        if ((command == transfer && running[kernel] > 0) || (command == kernel && running[transfer] > 0))
            ++beside[transfer];
    std::this_thread::sleep_for(std::chrono::microseconds(1250));
    --running[command];
    ++slept;
}

void delay(cl_command_queue queue, Command command, cl_uint events, const cl_event* wait) {
    if (slow)
        clEnqueueNativeKernel(queue, take_time, &command, sizeof command, 0, nullptr, nullptr, events, wait, nullptr);
}

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// The linker takes these before the library's.
extern "C" {

cl_int CL_API_CALL clEnqueueWriteBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                                        size_t size, const void* memory, cl_uint events, const cl_event* wait,
                                        cl_event* event) {
    static auto* const enqueue = next<decltype(clEnqueueWriteBuffer)>("clEnqueueWriteBuffer");
    delay(queue, up, events, wait);
    return enqueue(queue, buffer, blocking, offset, size, memory, events, wait, event);
}

cl_int CL_API_CALL clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                                       size_t size, void* memory, cl_uint events, const cl_event* wait,
                                       cl_event* event) {
    static auto* const enqueue = next<decltype(clEnqueueReadBuffer)>("clEnqueueReadBuffer");
    delay(queue, down, events, wait);
    return enqueue(queue, buffer, blocking, offset, size, memory, events, wait, event);
}

cl_int CL_API_CALL clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel of_program, cl_uint dimensions,
                                          const size_t* offset, const size_t* global, const size_t* local,
                                          cl_uint events, const cl_event* wait, cl_event* event) {
    static auto* const enqueue = next<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
    for (int of = 0; of < 4; ++of) delay(queue, kernel, events, wait);  // as long as a band's transfers
    return enqueue(queue, of_program, dimensions, offset, global, local, events, wait, event);
}

}  // extern "C"

namespace wrinkle::test {
namespace {

/// The device of the tests, as if its memory was not the host's, or was; and just so large that a band of the pass has
/// so many rows, where `in_flight` of them are in memory.
Device with_memory(bool own, const Pass& pass, std::uint32_t width, std::uint32_t rows, std::uint32_t in_flight) {
    Device other = device();
    other.info.own_memory = own;
    other.info.memory =
        std::uint64_t{16} * in_flight * rows * width * static_cast<std::uint64_t>(pass.bytes_per_pixel());
    return other;
}

HostFrame wall(std::uint32_t width, std::uint32_t height) {
    HostFrame frame(plane_frame(test_camera(), {width, height}, V{0, 0, 1}), test_camera());
    std::minstd_rand random(7);
    for (float& u : frame.pixels.at("uv.u")) u += 1e-4f * static_cast<float>(random() % 100);
    return frame;
}

/// Heights over a bare UV, whose slopes need neighbours: bands read a row of each other.
Scene scene_with_neighbours() {
    Scene scene = data_scene("height_map");
    for (Layer& layer : scene.layers) layer.mask = {};
    scene.lighting = {};
    return scene;
}

/// A pass of the same that takes arrays in bands of so many rows.
Pass in_bands(bool own, const Pass& pass, const Scene& scene, const Frame& frame, std::uint32_t rows,
              const PassOptions& options = {}) {
    const std::uint32_t in_flight = own ? 3 : 1;
    Pass made = evaluate(with_memory(own, pass, frame.size.width, rows, in_flight), scene, frame, options);
    EXPECT_EQ(band_grid(made.impl(), 1, in_flight).rows, rows);
    return made;
}

TEST(OwnMemory, GivesTheBitsOfAFrameInPlace) {
    const HostFrame frame = wall(61, 47);
    const Scene scene = scene_with_neighbours();
    Pass whole = evaluate(device(), scene, frame.frame, {});
    ASSERT_TRUE(whole.needs_neighbours());
    const Pixels want = run(whole, frame);
    for (const bool own : {false, true})
        for (const std::uint32_t rows : {1u, 5u, 47u}) {
            Pass pass = in_bands(own, whole, scene, frame.frame, rows);
            Pixels got;
            HostOutputs out;
            for (const std::string& name : pass.outputs()) out[name] = got[name] = std::vector<float>(frame.count());
            std::vector<double> told;
            wrinkle::run(pass, frame.planes(), out, [&](double share) { told.push_back(share); });
            EXPECT_EQ(got, want) << "bands of " << rows << " rows";
            EXPECT_EQ(told.size(), (47 + rows - 1) / rows);
            EXPECT_TRUE(std::ranges::is_sorted(told));
            EXPECT_EQ(told.back(), 1);
        }
}

/// Halves, octahedral normals, integers and pixels of several planes; and results with bytes that no plane lies in.
TEST(OwnMemory, GivesTheBitsOfStoredPlanesInPlace) {
    using enum PlaneEncoding;
    const HostFrame given = wall(61, 20);
    const StoredFrame frame(given, merged({interleaved("a", octahedral16, {"normal.x", "normal.y", "normal.z"}),
                                           interleaved("b", half, {"uv.u", "", "uv.v"}, 16),
                                           {{"depth", {.encoding = unorm16, .scale = 100}}}}));
    const PassOptions options{.output_formats =
                                  merged({interleaved("n", half, {"normal.x", "normal.y", "normal.z", ""}),
                                          {{"marked", {.encoding = uint32}}}})};
    const Scene scene = scene_with_neighbours();
    const auto results = [&](Pass& pass) {
        std::map<std::string, std::vector<std::byte>> out;
        HostByteOutputs spans;
        for (const std::string& name : pass.outputs()) {
            out[name].resize(frame.decoded.count() * 8, std::byte{0x5a});
            spans[name] = out[name];
        }
        pass.run(frame.planes(), spans);
        return out;
    };
    Pass whole = evaluate(device(), scene, frame.frame, options);
    ASSERT_TRUE(whole.needs_neighbours());
    const auto want = results(whole);
    for (std::size_t i = 0; i < frame.decoded.count(); ++i) {
        ASSERT_NE(want.at("n")[8 * i + 5], std::byte{0x5a}) << "z of the normal";
        ASSERT_EQ(want.at("n")[8 * i + 7], std::byte{0x5a}) << "nobody's";
    }
    for (const bool own : {false, true})
        for (const std::uint32_t rows : {3u, 7u}) {
            Pass pass = in_bands(own, whole, scene, frame.frame, rows, options);
            EXPECT_EQ(results(pass), want) << "bands of " << rows << " rows, own memory: " << own;
        }
}

std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

struct OfFile {
    std::string bytes;
    ErrorStats errors;
    std::vector<double> told;
};

/// data/gbuffer/small.exr through FrameRun: with planes that no kernel reads, condition and sampled errors where the
/// device has double precision.
OfFile through_file(const Device& on, Scene scene, bool checked) {
    const TempFolder place;
    const HostFrame frame = small_frame();
    const GBufferReader reader(data_folder / "gbuffer/small.exr");
    scene.output.passthrough = true;
    scene.output.condition = checked;
    Pass pass = evaluate(on, scene, frame.frame);
    OfFile result;
    PhaseClock clock;
    FrameRun run(pass.impl(), reader, clock);
    FrameOutputs outputs(scene, pass.impl(), reader, place / "out", std::nullopt);
    run.write_to(outputs);
    std::optional<Condition> condition;
    std::optional<ErrorSample> sample;
    if (checked) {
        run.add_condition(condition.emplace(on, scene, frame.frame));
        run.check_bands(sample.emplace(on, scene, frame.frame, ErrorBudget{.max_error = {}, .sample = 500}),
                        frame.frame.camera);
    }
    run.run([&](double share) { result.told.push_back(share); });
    std::vector<fs::path> files;
    outputs.finish(files);
    result.bytes = contents(files.front());
    if (sample) result.errors = sample->stats();
    return result;
}

TEST(OwnMemory, GivesTheFilesOfAFrameInPlace) {
    Scene scene = data_scene("noise");
    scene.lighting = {};
    const Pass pass = evaluate(device(), scene, small_frame().frame);
    const bool checked = device().info.fp64;
    const OfFile in_place = through_file(with_memory(false, pass, 120, 16, 5), scene, checked);
    const OfFile own = through_file(with_memory(true, pass, 120, 16, 5), scene, checked);
    EXPECT_EQ(own.told.size(), 5u) << "blocks of 16 rows";
    EXPECT_GT(own.bytes.size(), 10000u);
    EXPECT_TRUE(own.bytes == in_place.bytes);
    EXPECT_TRUE(own.bytes == through_file(device(), scene, checked).bytes) << "and of one band";
    EXPECT_EQ(own.errors.median, in_place.errors.median);
    EXPECT_EQ(own.errors.max, in_place.errors.max);
    EXPECT_EQ(own.errors.samples, in_place.errors.samples);
}

/// Expects that kernels run while other bands' planes are transferred, in both directions.
void expect_overlap(const std::function<void()>& work, int commands) {
    const auto can = device().device.getInfo<CL_DEVICE_EXECUTION_CAPABILITIES>();
    if ((can & CL_EXEC_NATIVE_KERNEL) == 0 || device().info.compute_units < 2) GTEST_SKIP() << "no way to make it slow";
    work();  // built, and warm
    beside[up] = beside[down] = 0;
    // Others keep the machine busy, and a driver may work on two queues at once at times only.
    for (int again = 0; again < 10 && (beside[up] == 0 || beside[down] == 0); ++again) {
        slept = 0;
        slow = true;
        work();
        slow = false;
        EXPECT_GE(slept, commands);
        std::cout << fmt::format("{} commands; {} up and {} down beside a kernel\n", slept, beside[up], beside[down]);
    }
    EXPECT_GT(beside[up], 0);
    EXPECT_GT(beside[down], 0);
}

// Four planes up, a kernel of four commands, three planes down.
TEST(OwnMemory, OfArraysOverlapsTransfersAndKernels) {
    constexpr std::uint32_t bands = 16;
    const HostFrame frame = wall(16, bands);
    const Scene scene;
    const Pass whole = evaluate(device(), scene, frame.frame, {});
    Pass pass = in_bands(true, whole, scene, frame.frame, 1);
    expect_overlap([&] { run(pass, frame); }, 11 * bands);
}

TEST(OwnMemory, OfFilesOverlapsTransfersAndKernels) {
    constexpr int bands = 16, rows = 16;
    const TempFolder place;
    write_exr(place / "tall.exr", 16, bands * rows, {"Z", "N.X", "N.Y", "N.Z"}, [](int channel, int, int) {
        return channel == 0 ? 5.0f : channel == 3 ? 1.0f : 0.0f;
    });
    const GBufferReader reader(place / "tall.exr");
    const HostFrame frame = wall(16, bands * rows);
    const Scene scene;
    const Pass whole = evaluate(device(), scene, frame.frame, {});
    Pass pass = evaluate(with_memory(true, whole, 16, rows, 5), scene, frame.frame, {});
    pass.impl().warm = true;
    expect_overlap(
        [&] {
            PhaseClock clock;
            FrameRun run(pass.impl(), reader, clock);
            FrameOutputs outputs = FrameOutputs::single(place / "out.exr", scene, pass.impl(), reader, {});
            run.write_to(outputs);
            run.run();
        },
        11 * bands);
}

}  // namespace
}  // namespace wrinkle::test
