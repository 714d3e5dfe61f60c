#include <fmt/format.h>

#include <cstring>

#include "baseline/baseline.h"
#include "contenders.h"
#include "io/texture_file.h"
#include "run/pass_impl.h"

namespace wrinkle::bench {

namespace {

constexpr std::size_t kErrorSamples = 4096;
constexpr std::uint32_t kSeed = 20201021;

/// A built pass with its planes on the device.
struct Resident {
    Pass pass;
    PlaneBuffers in, out;

    Resident(const Device& device, const Scene& scene, const BenchFrame& frame, bool split)
        : pass(evaluate(device, scene, frame.frame, {.lanes = 0, .fp64 = false, .split = split})) {
        in = upload(device, frame, pass.inputs());
        out = PlaneBuffers(device, pass.outputs(), frame.pixels(), sizeof(float));
    }

    void run() { pass.enqueue(in.planes(), out.planes()).wait(); }

    Normals normals(std::size_t pixels) {
        Normals n(pixels);
        for (auto [name, plane] : {std::pair{"normal.x", &n.x}, {"normal.y", &n.y}, {"normal.z", &n.z}})
            std::memcpy(plane->data(), out.map<float>(name, CL_MAP_READ), pixels * sizeof(float));
        out.unmap();
        return n;
    }
};

std::map<std::filesystem::path, baseline::Image> baseline_images(const Scene& scene) {
    std::map<std::filesystem::path, baseline::Image> images;
    const auto add = [&](const std::filesystem::path& file, ImageUse use) {
        Image image = load_texture(file, use);
        images[file] = {image.width, image.height, image.channels, std::move(image.texels)};
    };
    for (const Layer& layer : scene.layers) {
        std::visit(
            [&](const auto& bump) {
                if constexpr (requires { bump.texture; })
                    add(bump.texture.file,
                        bump.texture.content == Content::normal ? ImageUse::normal : ImageUse::scalar);
                if constexpr (requires { bump.textures; })
                    for (const TextureUse& use : bump.textures)
                        add(use.file, use.content == Content::height ? ImageUse::scalar : ImageUse::normal);
            },
            layer.bump);
        if (layer.mask.texture) add(layer.mask.texture->file, ImageUse::scalar);
    }
    return images;
}

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

}  // namespace

void measure_demo(const Device& device, const Scene& scene, const BenchFrame& frame, Report& report) {
    const auto build = [&] { Resident(device, scene, frame, false).run(); };
    report.cold_build = seconds_of(build);
    Resident fused(device, scene, frame, false), split(device, scene, frame, true);
    fused.run();
    fused.pass.impl().save();
    report.warm_build = seconds_of(build);

    const baseline::Evaluator plain(scene, frame.frame.size, frame.frame.camera, baseline_images(scene));
    Normals plain_normals(frame.pixels());
    const auto spans = frame.spans();
    std::vector<Contender> contenders{
        {"wrinkle, fused", [&] { fused.run(); }},
        {"plain C++ from the listings", [&] { plain.run(spans, plain_normals.x, plain_normals.y, plain_normals.z); }},
        {"wrinkle, one kernel a layer", [&] { split.run(); }}};
    race(contenders, report.repetitions);

    const ReferenceSample reference(scene, frame, kErrorSamples, kSeed);
    report.rows = {{contenders[0].name, contenders[0].seconds, reference.compare(fused.normals(frame.pixels()))},
                   {contenders[1].name, contenders[1].seconds, reference.compare(plain_normals)},
                   {contenders[2].name, contenders[2].seconds, reference.compare(split.normals(frame.pixels()))}};

    // Each layer alone; the empty scene, whose cost every one shares, is timed beside it.
    Scene empty_scene = scene;
    empty_scene.layers.clear();
    Resident empty(device, empty_scene, frame, false);
    for (const Layer& layer : scene.layers) {
        if (std::holds_alternative<ResolveLayer>(layer.bump)) continue;
        const Scene alone = only(scene, layer);
        Resident one(device, alone, frame, false);
        std::vector<Contender> pair{{layer.name, [&] { one.run(); }}, {"", [&] { empty.run(); }}};
        race(pair, std::max(3, report.repetitions / 3));
        Timing above = pair[0].seconds;
        above.spread *= above.median / std::max(above.median - pair[1].seconds.median, 1e-9);
        above.median -= pair[1].seconds.median;
        report.layers.push_back(
            {layer.name, above,
             ReferenceSample(alone, frame, kErrorSamples, kSeed).compare(one.normals(frame.pixels()))});
    }
}

}  // namespace wrinkle::bench
