#include "scenes.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>

#include "baseline/baseline.h"
#include "error.h"
#include "resident.h"
#include "run/pass_impl.h"
#include "shell.h"
#include "temporary_folder.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The scene with one of its layers only.
Scene only(const Scene& scene, const Layer& layer) {
    Scene alone = scene;
    alone.layers = {layer};
    return alone;
}

/// The plain C++ of the scene, or nothing where it does not know a layer.
std::optional<baseline::Evaluator> plain_evaluator(const Scene& scene, const BenchFrame& frame) {
    try {
        return baseline::Evaluator(scene, frame.frame.size, frame.frame.camera, baseline_images(scene));
    } catch (const baseline::Unsupported&) { return std::nullopt; }
}

void measure_layers(const Device& device, const Scene& scene, const BenchFrame& frame, Run& run) {
    Scene empty_scene = scene;
    empty_scene.layers.clear();
    Resident empty(device, empty_scene, frame);
    for (const Layer& layer : scene.layers) {
        if (std::holds_alternative<ResolveLayer>(layer.bump)) continue;
        const Scene alone = only(scene, layer);
        Resident one(device, alone, frame);
        std::vector<Contender> pair{{layer.name, [&] { one.run(); }}, {"", [&] { empty.run(); }}};
        race(pair, std::max(3, run.repetitions / 3));
        Timing above = pair[0].seconds;
        above.spread *= above.median / std::max(above.median - pair[1].seconds.median, 1e-9);
        above.median -= pair[1].seconds.median;
        above.runs.clear();
        const ReferenceSample reference(alone, frame, kErrorSamples, kSeed);
        run.measurements.push_back(scene_measurement("layer", layer.name, "above the empty scene", device.info.lanes,
                                                     above, one.pass, one.normals(frame.pixels()), reference));
    }
}

/// Errors of the same kernels on a frame that fits into memory at once.
ErrorStats sampled_error(const Device& device, const Scene& scene, const Resampler& resampler, Size size) {
    const BenchFrame frame = resampler.frame({std::min(size.width, 3840u), std::min(size.height, 2160u)});
    Resident whole(device, scene, frame);
    whole.run();
    return ReferenceSample(scene, frame, kErrorSamples, kSeed).compare(whole.normals(frame.pixels()));
}

/// Seconds that `wrinkle run` takes to have the kernels of a scene: built, and from the cache that leaves.
std::array<double, 2> build_seconds(const Device& device, const std::filesystem::path& scene) {
    const TemporaryFolder folder;
    const std::string at = folder.path().string();
    std::array<double, 2> builds{};
    for (double& seconds : builds) {
        call(fmt::format(
            "WRINKLE_CACHE_DIR='{0}' POCL_CACHE_DIR='{0}' '{1}' run '{2}' --device '{3}' -o '{0}/out' --json "
            ">'{0}/report.json'",
            at, WRINKLE_CLI, scene.string(), device.info.name));
        seconds = nlohmann::json::parse(std::ifstream(at + "/report.json")).at("seconds").at("build").get<double>();
    }
    return builds;
}

/// Bytes of memory that this process holds.
double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double pages = 0;
    statm >> pages >> pages;
    return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void measure_scene(const Device& device, const std::filesystem::path& file, Size size, bool layers, Run& run) {
    const Scene from_file = load_scene(file);
    const BenchFrame frame = Resampler(from_file).frame(size);
    const Scene scene = without_lighting(from_file, frame.frame);
    const ReferenceSample reference(scene, frame, kErrorSamples, kSeed);

    Resident fused(device, scene, frame), split(device, scene, frame, {.split = true});
    const auto plain = plain_evaluator(scene, frame);
    Normals plain_normals(frame.pixels());
    const auto spans = frame.spans();
    std::vector<Contender> contenders{{"fused", [&] { fused.run(); }}, {"one kernel a layer", [&] { split.run(); }}};
    if (plain)
        contenders.push_back(
            {"plain C++", [&] { plain->run(spans, plain_normals.x, plain_normals.y, plain_normals.z); }});
    race(contenders, run.repetitions);
    const auto add = [&](std::size_t k, const Normals& normals, int lanes) {
        run.measurements.push_back(scene_measurement("scene", file.stem(), contenders[k].name, lanes,
                                                     contenders[k].seconds, fused.pass, normals, reference));
    };
    add(0, fused.normals(frame.pixels()), device.info.lanes);
    const std::array<double, 2> builds = build_seconds(device, file);
    run.measurements.back().figures = {{"s to build the kernels", builds[0]},
                                       {"s to take them from the cache", builds[1]}};
    add(1, split.normals(frame.pixels()), device.info.lanes);
    if (plain) add(2, plain_normals, 0);
    if (layers) measure_layers(device, scene, frame, run);
}

void measure_sizes(const Device& device, const std::filesystem::path& file, const std::vector<Size>& sizes, Run& run) {
    const Scene from_file = load_scene(file);
    const Resampler resampler(from_file);
    for (const Size size : sizes) {
        ::malloc_trim(0);  // what earlier sizes let go
        const double held_before = resident_bytes();
        double held = 0;
        Frame shape = resampler.description();
        shape.size = size;
        const Scene scene = without_lighting(from_file, shape);
        Pass pass = evaluate(device, scene, shape);
        constexpr std::uint32_t kBandPixels = 1u << 21;
        const std::uint32_t band = std::max(kBandPixels / size.width, 1u), margin = pass.needs_neighbours() ? 1 : 0;
        PlaneBuffers in(device, pass.inputs(), std::size_t{band + 2} * size.width, sizeof(float)),
            out(device, pass.outputs(), std::size_t{band} * size.width, sizeof(float));
        std::vector<double> totals(static_cast<std::size_t>(std::max(3, run.repetitions / 3)));
        for (std::uint32_t first = 0; first < size.height; first += band) {
            const std::uint32_t count = std::min(band, size.height - first), before = std::min(first, margin),
                                after = std::min(size.height - first - count, margin);
            for (const auto& [name, plane] :
                 resampler.rows(size, first - before, count + before + after, pass.inputs()))
                std::ranges::copy(plane, in.map<float>(name, CL_MAP_WRITE));
            in.unmap();
            const Rows rows{first, count, before, after};
            pass.enqueue(in.planes(), out.planes(), rows).wait();
            held = std::max(held, resident_bytes() - held_before);
            for (double& total : totals)
                total += seconds_of([&] { pass.enqueue(in.planes(), out.planes(), rows).wait(); });
        }
        Measurement m{.group = "size",
                      .name = file.stem(),
                      .variant = fmt::format("{:.0f} Mpixel", 1e-6 * size.width * size.height),
                      .lanes = device.info.lanes,
                      .pixels = std::size_t{size.width} * size.height,
                      .seconds = timing(totals),
                      .bytes = bytes_of(pass),
                      .operations = operations_of(pass),
                      .at_most = true};
        m.memory = held;
        m.error = sampled_error(device, scene, resampler, size);
        run.measurements.push_back(m);
    }
}

}  // namespace wrinkle::bench
