#include "scenes.h"

#include <fmt/format.h>

#include <cstring>

#include "baseline/baseline.h"
#include "error.h"
#include "io/texture_file.h"
#include "run/pass_impl.h"
#include "wrinkle/error.h"

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
    for_each_texture(scene, [&](const TextureUse& use) {
        Image image = load_bump(use);
        images[use.file] = {image.width, image.height, image.channels, std::move(image.texels)};
    });
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

double operations_of(const Plan& plan) {
    double sum = 0;
    for (const SectionSummary& section : plan.sections) sum += section.operations;
    return sum;
}

struct Subject {
    std::string group, name;
    const BenchFrame& frame;
    const ReferenceSample& reference;

    Measurement measured(const std::string& variant, int lanes, const Timing& seconds, const Plan& plan,
                         const Normals& normals) const {
        Measurement m{.group = group,
                      .name = name,
                      .variant = variant,
                      .lanes = lanes,
                      .pixels = frame.pixels(),
                      .seconds = seconds,
                      .bytes = plan.bytes,
                      .operations = operations_of(plan)};
        m.error = reference.compare(normals);
        m.hash = hash_of(normals.x.data(), normals.x.size() * sizeof(float));
        return m;
    }
};

/// The plain C++ of the scene, or nothing where it does not know a layer.
std::optional<baseline::Evaluator> plain_evaluator(const Scene& scene, const BenchFrame& frame) {
    try {
        return baseline::Evaluator(scene, frame.frame.size, frame.frame.camera, baseline_images(scene));
    } catch (const baseline::Unsupported&) { return std::nullopt; }
}

void measure_layers(const Device& device, const Scene& scene, const BenchFrame& frame, Run& run) {
    Scene empty_scene = scene;
    empty_scene.layers.clear();
    Resident empty(device, empty_scene, frame, false);
    for (const Layer& layer : scene.layers) {
        if (std::holds_alternative<ResolveLayer>(layer.bump)) continue;
        const Scene alone = only(scene, layer);
        Resident one(device, alone, frame, false);
        std::vector<Contender> pair{{layer.name, [&] { one.run(); }}, {"", [&] { empty.run(); }}};
        race(pair, std::max(3, run.repetitions / 3));
        Timing above = pair[0].seconds;
        above.spread *= above.median / std::max(above.median - pair[1].seconds.median, 1e-9);
        above.median -= pair[1].seconds.median;
        const ReferenceSample reference(alone, frame, kErrorSamples, kSeed);
        const Subject subject{"layer", layer.name, frame, reference};
        run.measurements.push_back(subject.measured("above the empty scene", device.info.lanes, above,
                                                    one.pass.impl().plan, one.normals(frame.pixels())));
    }
}

/// Errors of the same kernels on a frame that fits into memory at once.
ErrorStats sampled_error(const Device& device, const Scene& scene, const Resampler& resampler, Size size) {
    const BenchFrame frame = resampler.frame({std::min(size.width, 3840u), std::min(size.height, 2160u)});
    Resident whole(device, scene, frame, false);
    whole.run();
    return ReferenceSample(scene, frame, kErrorSamples, kSeed).compare(whole.normals(frame.pixels()));
}

}  // namespace

void measure_scene(const Device& device, const std::filesystem::path& file, Size size, bool layers, Run& run) {
    const Scene from_file = load_scene(file);
    const BenchFrame frame = Resampler(from_file).frame(size);
    const Scene scene = without_lighting(from_file, frame.frame);
    const ReferenceSample reference(scene, frame, kErrorSamples, kSeed);
    const Subject subject{"scene", file.stem(), frame, reference};

    const auto build = [&] { Resident(device, scene, frame, false).run(); };
    const double cold = seconds_of(build);
    Resident fused(device, scene, frame, false), split(device, scene, frame, true);
    fused.run();
    fused.pass.impl().save();
    const double warm = seconds_of(build);

    const auto plain = plain_evaluator(scene, frame);
    Normals plain_normals(frame.pixels());
    const auto spans = frame.spans();
    std::vector<Contender> contenders{{"fused", [&] { fused.run(); }}, {"one kernel a layer", [&] { split.run(); }}};
    if (plain)
        contenders.push_back(
            {"plain C++", [&] { plain->run(spans, plain_normals.x, plain_normals.y, plain_normals.z); }});
    race(contenders, run.repetitions);
    const Plan& plan = fused.pass.impl().plan;
    const auto add = [&](std::size_t k, const Normals& normals, int lanes) {
        run.measurements.push_back(subject.measured(contenders[k].name, lanes, contenders[k].seconds, plan, normals));
    };
    add(0, fused.normals(frame.pixels()), device.info.lanes);
    add(1, split.normals(frame.pixels()), device.info.lanes);
    if (plain) add(2, plain_normals, 0);
    for (const auto& [variant, seconds] : {std::pair{"cold build", cold}, {"build from the cache", warm}}) {
        Measurement m = run.measurements.back();
        m.group = "start", m.variant = variant, m.seconds = {seconds, 0}, m.lanes = device.info.lanes;
        run.measurements.push_back(m);
    }
    if (layers) measure_layers(device, scene, frame, run);
}

void measure_sizes(const Device& device, const std::filesystem::path& file, const std::vector<Size>& sizes, Run& run) {
    const Scene from_file = load_scene(file);
    const Resampler resampler(from_file);
    for (const Size size : sizes) {
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
            for (double& total : totals)
                total += seconds_of([&] { pass.enqueue(in.planes(), out.planes(), rows).wait(); });
        }
        Measurement m{.group = "size",
                      .name = file.stem(),
                      .variant = "fused, in bands",
                      .lanes = device.info.lanes,
                      .pixels = std::size_t{size.width} * size.height,
                      .seconds = timing(totals),
                      .bytes = pass.impl().plan.bytes,
                      .operations = operations_of(pass.impl().plan)};
        m.error = sampled_error(device, scene, resampler, size);
        run.measurements.push_back(m);
    }
}

}  // namespace wrinkle::bench
