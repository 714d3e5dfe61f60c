// Frames through a device with a memory of its own, on one that has none: the same bits, and transfers while kernels
// run.
#include "run/staged_bands.h"

#include <chrono>
#include <random>
#include <thread>

#include "plan/stored_planes.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using Clock = std::chrono::steady_clock;

/// The device of the tests, as if its memory was not the host's.
Device with_own_memory() {
    Device other = device();
    other.info.own_memory = true;
    return other;
}

HostBytes bytes_in(const HostFrame& frame) {
    HostBytes in;
    for (const auto& [name, plane] : frame.pixels) in.emplace(name, std::as_bytes(std::span(plane)));
    return in;
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

TEST(StagedBands, GiveTheBitsOfAFrameInPlace) {
    const HostFrame frame = wall(61, 47);
    Pass pass = evaluate(with_own_memory(), scene_with_neighbours(), frame.frame, {});
    ASSERT_TRUE(pass.needs_neighbours());
    Pass in_place = evaluate(device(), scene_with_neighbours(), frame.frame, {});
    const Pixels want = run(in_place, frame);
    EXPECT_EQ(run(pass, frame), want) << "through Pass::run";
    for (const std::size_t rows : {1, 5, 47}) {
        Pixels got;
        HostByteOutputs out;
        for (const std::string& name : pass.outputs())
            out[name] = std::as_writable_bytes(std::span(got[name] = std::vector<float>(frame.count(), -77.f)));
        double told = 0;
        run_staged(pass.impl(), bytes_in(frame), out,
                   [&](double share) {
                       EXPECT_GT(share, told);
                       told = share;
                   },
                   {.band_pixels = rows * 61, .delay = {}});
        EXPECT_EQ(told, 1);
        EXPECT_EQ(got, want) << "bands of " << rows << " rows";
    }
}

TEST(StagedBands, LeaveBytesThatNoPlaneLiesIn) {
    const HostFrame frame = wall(33, 20);
    Scene scene;
    const PassOptions options{
        .output_formats = interleaved("normals", PlaneEncoding::half, {"normal.x", "normal.y", "normal.z", ""})};
    Pass pass = evaluate(with_own_memory(), scene, frame.frame, options);
    std::vector<std::uint16_t> out(frame.count() * 4, 0xabcd);
    run_staged(pass.impl(), bytes_in(frame), {{"normals", std::as_writable_bytes(std::span(out))}}, {},
               {.band_pixels = 33 * 7, .delay = {}});
    for (std::size_t i = 0; i < frame.count(); ++i) {
        ASSERT_EQ(out[4 * i + 2], 0x3c00) << i;  // 1, as the wall faces z
        ASSERT_EQ(out[4 * i + 3], 0xabcd) << i;
    }
}

TEST(StagedBands, AreAsLargeAsMemoryAndTransfersWant) {
    EXPECT_EQ(staged_band_pixels(std::uint64_t{128} << 30, 40), std::size_t{1} << 22);
    EXPECT_EQ(staged_band_pixels(std::uint64_t{2} << 30, 64), (std::size_t{2} << 30) / 16 / (3 * 64));
    EXPECT_EQ(staged_band_pixels(1 << 20, 400), std::size_t{1} << 16);
}

void CL_CALLBACK sleep_5_ms(void*) { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

// Uploads, kernels and downloads take 5 ms each. One after another that is 15 ms a band; beside one another, 5 ms on a
// driver that works on three queues at once, and 7.5 where two threads do.
TEST(StagedBands, TransferWhileKernelsRun) {
    const auto can = device().device.getInfo<CL_DEVICE_EXECUTION_CAPABILITIES>();
    if ((can & CL_EXEC_NATIVE_KERNEL) == 0 || device().info.compute_units < 2) GTEST_SKIP() << "no way to make it slow";
    constexpr std::uint32_t bands = 16;
    const HostFrame frame = wall(16, bands);
    Scene scene;
    Pass pass = evaluate(with_own_memory(), scene, frame.frame, {});
    Pixels got = run(pass, frame);  // built, and warm
    HostByteOutputs out;
    for (auto& [name, plane] : got) out[name] = std::as_writable_bytes(std::span(plane));
    std::size_t delays = 0;
    const StagedOptions options{.band_pixels = 16, .delay = [&](cl::CommandQueue queue, const auto& wait) {
                                    ++delays;
                                    queue.enqueueNativeKernel(sleep_5_ms, {nullptr, 0}, nullptr, nullptr, &wait);
                                }};
    const auto run_slowly = [&] {
        delays = 0;
        const auto began = Clock::now();
        run_staged(pass.impl(), bytes_in(frame), out, {}, options);
        return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
    };
    double took = run_slowly();
    for (int again = 0; again < 4; ++again) took = std::min(took, run_slowly());  // others keep the machine busy
    EXPECT_EQ(delays, 3 * bands);
    std::cout << fmt::format("{} bands: {:.0f} ms; one after another {} ms\n", bands, took, 15 * bands);
    EXPECT_LT(took, 0.8 * 15 * bands);
}

}  // namespace
}  // namespace wrinkle::test
