#include <deque>

#include "area_truth.h"
#include "contests.h"
#include "run/pass_impl.h"
#include "stored_pass.h"
#include "texture_system.h"

namespace wrinkle::bench {

namespace {

using enum PlaneEncoding;

const std::vector<std::string> kNormal{"normal.x", "normal.y", "normal.z"}, kUv{"uv.u", "uv.v"};

std::vector<StoredWay> ways() {
    std::vector<std::string> all = kNormal, pixels = kNormal, normals = kNormal;
    all.insert(all.end(), {"depth", "uv.u", "uv.v"}), pixels.emplace_back("depth"), normals.emplace_back();
    const PlaneFormats octahedral = interleaved("normal", octahedral16, kNormal);
    return {
        {"float", {}, {}},
        {"half", planar(half, all), planar(half, kNormal)},
        {"octahedral normals, halves", united({octahedral, planar(half, kUv), planar(half, {"depth"})}), octahedral},
        {"RGBA16F", united({interleaved("pixels", half, pixels), interleaved("uv", half, kUv)}),
         interleaved("normals", half, normals)},
        {"octahedral normals, floats", octahedral, octahedral}};
}

/// What a pass wrote.
Vectors normals_of(StoredPass& stored, std::size_t pixels) {
    Vectors out;
    const StoredVectors vectors(stored.out, stored.pass.impl().plan.output_formats, "normal.x");
    for (std::size_t i = 0; i < pixels; ++i) {
        const reference::Vec<double> n = vectors.at(i);
        out.push_back({n.x, n.y, n.z});
    }
    stored.out.unmap();
    return out;
}

}  // namespace

void measure_stored_area(const Device& device, Run& run) {
    const AreaSurface surface = area_surfaces().front();
    const BenchFrame frame = surface.frame(1);
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "cobbles", scene.layers[0].scale = 0.05;
    HeightMapLayer cobbles{.texture = {.file = WRINKLE_SOURCE_DIR "/data/textures/cobbles_height.png"}};
    scene.layers[0].bump = cobbles;
    scene.filter.taps = 16;
    const AreaTruth truth(surface, scene);
    for (const char* name : {"cobbles by UV", "cobbles by depth"}) {
        std::deque<StoredPass> passes;
        std::vector<Contender> contenders;
        for (const StoredWay& way : ways()) {
            StoredPass& pass = passes.emplace_back(device, scene, frame, way);
            contenders.push_back({way.name, [&pass] { pass.run(); }});
        }
        race(contenders, few(run.rounds));
        for (std::size_t k = 0; k < passes.size(); ++k) {
            Measurement m = measured("storage", name, contenders[k], device.info.lanes, frame.pixels());
            m.bytes = passes[k].pass.bytes_per_pixel();
            m.error = truth.compare(normals_of(passes[k], frame.pixels()));
            run.measurements.push_back(std::move(m));
        }
        cobbles.uv.source = UvSource::planar;
        cobbles.uv.scale = {1 / kGroundRepeat, 1 / kGroundRepeat};
        scene.layers[0].bump = cobbles;
    }
}

}  // namespace wrinkle::bench
