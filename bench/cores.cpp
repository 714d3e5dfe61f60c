#include <fmt/format.h>

#include <optional>

#include "bench_kernel.h"
#include "contests.h"
#include "ratio.h"
#include "resident.h"

namespace wrinkle::bench {

namespace {

/// A device of some of the cores of `device`.
Device part_of(const Device& device, cl_uint cores) {
    const cl_device_partition_property by_counts[] = {CL_DEVICE_PARTITION_BY_COUNTS, static_cast<intptr_t>(cores),
                                                      CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    std::vector<cl::Device> parts;
    cl::Device whole = device.device;
    whole.createSubDevices(by_counts, &parts);
    const cl::Context context(parts.front());
    return Device::adopt(context, cl::CommandQueue(context, parts.front()));
}

/// Arithmetic that touches no memory. How much faster two cores do it is the most that any scene can gain, on this
/// machine at this time.
std::function<void()> multiply_adds(const Device& device) {
    constexpr std::size_t kPixels = std::size_t{1} << 20;
    std::vector<cl::Buffer> in_and_out;
    for (int k = 0; k < 2; ++k) in_and_out.emplace_back(device.context, CL_MEM_READ_WRITE, kPixels * sizeof(float));
    device.queue.enqueueFillBuffer(in_and_out[0], 0.5f, 0, kPixels * sizeof(float));
    return BenchKernels(device, "memory.cl").launcher("wr_fma_chains", in_and_out, kPixels);
}

}  // namespace

void measure_cores(const Device& device, Size size, Run& run) {
    if (device.info.type != "cpu" || device.info.compute_units < 2) return;
    const std::pair<const char*, std::filesystem::path> scenes[] = {
        {"arithmetic", WRINKLE_SOURCE_DIR "/bench/scenes/arithmetic.toml"}, {"decal_stack", stack_scene()}};
    std::optional<Device> one, two;
    try {
        one = part_of(device, 1), two = device.info.compute_units == 2 ? device : part_of(device, 2);
    } catch (const cl::Error&) {
        fmt::print("one core and two: this device cannot be divided\n");
        return;
    }
    for (const auto& [name, file] : scenes) {
        const Scene from_file = load_scene(file);
        const BenchFrame frame = Resampler(from_file).frame(size);
        const Scene scene = without_lighting(from_file, frame.frame);
        const ReferenceSample reference(scene, frame, kErrorSamples, kSeed);
        Resident on_one(*one, scene, frame, {.lanes = device.info.lanes}),
            on_two(*two, scene, frame, {.lanes = device.info.lanes});
        std::vector<Contender> contenders{{"one core", [&] { on_one.run(); }},
                                          {"two cores", [&] { on_two.run(); }},
                                          {"", multiply_adds(*one)},
                                          {"", multiply_adds(*two)}};
        race(contenders, run.rounds);
        for (const auto& [contender, resident] :
             {std::pair{&contenders[0], &on_one}, std::pair{&contenders[1], &on_two}})
            run.measurements.push_back(scene_measurement("cores", name, contender->name, device.info.lanes,
                                                         contender->seconds, resident->pass,
                                                         resident->normals(frame.pixels()), reference));
        run.measurements.back().figures["times as many multiply-adds on two, in the same race"] =
            ratio(contenders[2].seconds, contenders[3].seconds).value;
    }
}

}  // namespace wrinkle::bench
