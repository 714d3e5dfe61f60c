#include "baseline/stack.h"

#include "contests.h"
#include "resident.h"

namespace wrinkle::bench {

std::filesystem::path stack_scene() { return WRINKLE_SOURCE_DIR "/bench/bars/decal_stack.toml"; }

void measure_stack(const Device& device, Size size, Run& run) {
    const Scene from_file = load_scene(stack_scene());
    const BenchFrame frame = Resampler(from_file).frame(size);
    const Scene scene = without_lighting(from_file, frame.frame);
    const ReferenceSample reference(scene, frame, kErrorSamples, kSeed);
    Resident resident(device, scene, frame);
    const baseline::DecalStack stack(scene, size, frame.frame.camera, baseline_images(scene));
    const auto planes = frame.spans();
    Normals normals(frame.pixels());
    const baseline::Planes out{normals.x, normals.y, normals.z};

    const auto forms = baseline::stack_forms();
    std::vector<Contender> contenders{{"standard", [&] { resident.run(); }}};
    for (const auto& [name, rows] : forms)
        contenders.push_back({name, [&, form = rows] { stack.run(form, planes, out); }});
    race(contenders, run.rounds);
    const auto add = [&](const Contender& contender, int lanes, const Normals& got) {
        run.measurements.push_back(scene_measurement("stack", "decal_stack", contender.name, lanes, contender.seconds,
                                                     resident.pass, got, reference));
    };
    add(contenders.front(), device.info.lanes, resident.normals(frame.pixels()));
    for (std::size_t k = 1; k < contenders.size(); ++k) {
        contenders[k].work();
        add(contenders[k], 0, normals);
    }
}

}  // namespace wrinkle::bench
