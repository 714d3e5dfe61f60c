#include "resident.h"

#include <cstring>

#include "baseline/baseline.h"
#include "io/texture_file.h"
#include "run/pass_impl.h"
#include "tests/reference/scene_images.h"

namespace wrinkle::bench {

Resident::Resident(const Device& device, const Scene& scene, const BenchFrame& frame, const PassOptions& options)
    : Resident(device, evaluate(device, scene, frame.frame, options), frame) {}

Resident::Resident(const Device& device, Pass built, const BenchFrame& frame) : pass(std::move(built)) {
    in = upload(device, frame, pass.inputs());
    out = PlaneBuffers(device, pass.outputs(), frame.pixels(), sizeof(float));
}

Normals Resident::normals(std::size_t pixels) {
    Normals n(pixels);
    for (auto [name, plane] : {std::pair{"normal.x", &n.x}, {"normal.y", &n.y}, {"normal.z", &n.z}})
        std::memcpy(plane->data(), out.map<float>(name, CL_MAP_READ), pixels * sizeof(float));
    out.unmap();
    return n;
}

double operations_of(Pass& pass) {
    double sum = 0;
    for (const SectionSummary& section : pass.impl().plan.sections) sum += section.operations;
    return sum;
}

double bytes_of(Pass& pass) { return pass.impl().plan.bytes; }

Measurement scene_measurement(const std::string& group, const std::string& name, const std::string& variant, int lanes,
                              const Timing& seconds, Pass& work, const Normals& normals,
                              const ReferenceSample& reference) {
    Measurement m{.group = group,
                  .name = name,
                  .variant = variant,
                  .lanes = lanes,
                  .pixels = normals.x.size(),
                  .seconds = seconds,
                  .bytes = bytes_of(work),
                  .operations = operations_of(work),
                  .at_most = true};
    m.error = reference.compare(normals);
    m.hash = hash_of(normals.x.data(), normals.x.size() * sizeof(float));
    return m;
}

std::map<std::filesystem::path, baseline::Image> baseline_images(const Scene& scene) {
    std::map<std::filesystem::path, baseline::Image> images;
    reference::for_each_texture(scene, [&](const TextureUse& use) {
        Image image = load_bump(use);
        images[use.file] = {image.width, image.height, image.channels, std::move(image.texels)};
    });
    return images;
}

}  // namespace wrinkle::bench
