#include "scenes.h"

#include <fmt/format.h>

#include <fstream>

#include "baseline/baseline.h"
#include "error.h"
#include "resident.h"
#include "shell.h"
#include "temporary_folder.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

/// The scene with one of its layers only.
Scene only(const Scene& scene, const Layer& layer) {
    Scene alone = scene;
    alone.layers = {layer};
    return alone;
}

/// The scene in plain C++; nothing when one of its layers has no such form.
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
        race(pair, {run.rounds.least});
        std::vector<double> more = pair[0].seconds.runs;
        for (std::size_t round = 0; round < more.size(); ++round) more[round] -= pair[1].seconds.runs[round];
        const Timing above = timing(std::move(more));
        const ReferenceSample reference(alone, frame, kErrorSamples, kSeed);
        run.measurements.push_back(scene_measurement("layer", layer.name, "above the empty scene", device.info.lanes,
                                                     above, one.pass, one.normals(frame.pixels()), reference));
    }
}

/// Seconds until `wrinkle run` has the kernels of a scene: when it has to build them, and when they are in the cache.
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
    race(contenders, run.rounds);
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

}  // namespace wrinkle::bench
