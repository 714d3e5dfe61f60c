#include <memory>

#include "contests.h"
#include "resident.h"

namespace wrinkle::bench {

void measure_lighting(const Device& device, const std::filesystem::path& file, Size size, Run& run) {
    const Scene from_file = load_scene(file);
    const BenchFrame frame = Resampler(from_file).frame(size);
    const Scene normals = without_lighting(from_file, frame.frame);
    Scene lit = normals, disc = normals, area = normals, lit_area = normals;
    lit.lighting = disc.lighting = lit_area.lighting = from_file.lighting;
    area.filter = lit_area.filter = from_file.filter;
    for (Light& light : disc.lighting.lights)
        if (light.kind == LightKind::sun) light.angle = 0.0092;  // radians: the sun's, and Blender's default
    struct Way {
        const char* name;
        const Scene& scene;
    };
    const Way ways[] = {{"normals only", normals},
                        {"lit", lit},
                        {"lit by suns with a disc", disc},
                        {"normals only, of areas", area},
                        {"lit, of areas", lit_area}};
    std::vector<std::unique_ptr<Resident>> residents;
    std::vector<Contender> contenders;
    for (const Way& way : ways) {
        residents.push_back(std::make_unique<Resident>(device, way.scene, frame));
        contenders.push_back({way.name, [resident = residents.back().get()] { resident->run(); }});
    }
    race(contenders, run.rounds);
    const ReferenceSample reference(normals, frame, kErrorSamples, kSeed);
    for (std::size_t k = 0; k < contenders.size(); ++k)
        run.measurements.push_back(scene_measurement("lighting", file.stem(), contenders[k].name, device.info.lanes,
                                                     contenders[k].seconds, residents[k]->pass,
                                                     residents[k]->normals(frame.pixels()), reference));
}

}  // namespace wrinkle::bench
