#include <fmt/format.h>

#include <memory>

#include "contests.h"
#include "resident.h"
#include "run/pass_impl.h"

namespace wrinkle::bench {

namespace {

/// The scene with further layers in front, of kinds, textures and noises that it does not use. Their scale is 0: they
/// are compiled in, and bump nothing.
Scene with_everything(Scene scene) {
    const std::filesystem::path folder = WRINKLE_SOURCE_DIR "/data/scenes";
    std::vector<Layer> others;
    for (const char* file :
         {"noise_family", "combine", "object_normal", "derivative_map", "triplanar_object", "constant"})
        for (Layer& layer : load_scene(folder / fmt::format("{}.toml", file)).layers) {
            if (std::holds_alternative<ResolveLayer>(layer.bump)) continue;
            layer.name = fmt::format("{}: {}", file, layer.name);
            layer.scale = 0, layer.mask = {};
            others.push_back(std::move(layer));
        }
    scene.layers.insert(scene.layers.begin(), others.begin(), others.end());
    return scene;
}

Scene without_footprints(Scene scene) {
    for (Layer& layer : scene.layers) layer.footprint = false;
    return scene;
}

}  // namespace

void measure_ablation(const Device& device, const std::filesystem::path& file, Size size, Run& run) {
    const Scene from_file = load_scene(file);
    const BenchFrame frame = Resampler(from_file).frame(size);
    const Scene scene = without_lighting(from_file, frame.frame), everything = with_everything(scene),
                unlimited = without_footprints(scene);
    const ReferenceSample reference(scene, frame, kErrorSamples, kSeed),
        unlimited_reference(unlimited, frame, kErrorSamples, kSeed);
    struct Way {
        const char* variant;
        const Scene& scene;
        PlanOptions options;
        const ReferenceSample& reference;
    };
    const Way ways[] = {{"only what it needs", scene, {}, reference},
                        {"everything, by branches", everything, {.switches = true}, reference},
                        {"numbers compiled in", scene, {.compiled_numbers = true}, reference},
                        {"no skipping", scene, {.skip = false}, reference},
                        {"no footprints", unlimited, {}, unlimited_reference},
                        {"no fusing", scene, {.split = true}, reference}};
    std::vector<std::unique_ptr<Resident>> residents;
    std::vector<Contender> contenders;
    for (const Way& way : ways) {
        Pass pass(std::make_unique<Pass::Impl>(device, way.scene, frame.frame, PassOptions{}, way.options));
        residents.push_back(std::make_unique<Resident>(device, std::move(pass), frame));
        contenders.push_back({way.variant, [resident = residents.back().get()] { resident->run(); }});
    }
    race(contenders, run.rounds);
    for (std::size_t k = 0; k < contenders.size(); ++k)
        run.measurements.push_back(scene_measurement("ablation", file.stem(), contenders[k].name, device.info.lanes,
                                                     contenders[k].seconds, residents[k]->pass,
                                                     residents[k]->normals(frame.pixels()), ways[k].reference));
}

}  // namespace wrinkle::bench
