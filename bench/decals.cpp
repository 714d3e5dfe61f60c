#include "decals.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>

#include "baseline/decals.h"
#include "device/program.h"
#include "io/texture_file.h"
#include "run/pass_impl.h"
#include "run/scatter.h"
#include "tests/reference/projector.h"

namespace wrinkle::bench {

namespace {

constexpr std::size_t kErrorSamples = 256;  // the reference asks every decal
const std::filesystem::path kData = WRINKLE_SOURCE_DIR "/data";

Scene scene_of(std::vector<Projector> rows) {
    Scene scene = load_scene(kData / "scenes/decals.toml");
    scene.lighting = {};
    DecalsLayer layer;
    layer.textures = {{.file = kData / "textures/seal_height.png"},
                      {.file = kData / "textures/cracks_height.png"},
                      {.file = kData / "textures/weave_normal.png", .content = Content::normal}};
    layer.rows = std::make_shared<const std::vector<Projector>>(std::move(rows));
    scene.layers.assign(1, {});
    scene.layers[0].name = "many";
    scene.layers[0].bump = std::move(layer);
    return scene;
}

std::vector<Projector> rows_of(const BenchFrame& frame, const DecalMeasurement& wanted, std::size_t count,
                               double half_size) {
    ScatterOptions options;
    options.count = count;
    options.pixels = true;
    options.spacing = 0.25 * half_size;
    options.half_size = {half_size, half_size};
    options.textures = 3;
    options.mode = wanted.replace ? ProjectorMode::replace : ProjectorMode::add;
    options.opacity = wanted.replace ? 0.7 : 1;
    return scatter_decals(options, frame.frame, frame.spans());
}

/// A built pass with its planes on the device.
struct Resident {
    Scene scene;
    Pass pass;
    PlaneBuffers in, out;

    Resident(const Device& device, Scene given, const BenchFrame& frame, int lanes)
        : scene(std::move(given)), pass(evaluate(device, scene, frame.frame, {.lanes = lanes})) {
        in = upload(device, frame, pass.inputs());
        out = PlaneBuffers(device, pass.outputs(), frame.pixels(), sizeof(float));
    }
    void run() { pass.enqueue(in.planes(), out.planes()).wait(); }
    void bin() {
        Pass::Impl& impl = pass.impl();
        std::vector<cl::Buffer> planes;
        for (const std::string& name : impl.plan.tiles->inputs) planes.push_back(in.planes().at(name));
        impl.bins
            .enqueue(impl.frame, planes, {.first = 0, .count = impl.size.height}, impl.size.width, 0,
                     impl.size.width * impl.size.height, {})
            .wait();
    }
};

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// As race(), by processor time.
void race_on_processor(std::vector<Contender>& contenders, int repetitions) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int r = -1; r < repetitions; ++r)
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const double start = processor_seconds();
            contenders[i].work();
            if (r >= 0) times[i].push_back(processor_seconds() - start);
        }
    for (std::size_t i = 0; i < contenders.size(); ++i) contenders[i].seconds = timing(times[i]);
}

/// Coverage and what of the lists is for nothing, pixel by pixel.
struct Coverage {
    double per_pixel = 0, listed = 0;
};

Coverage coverage_of(Resident& resident, const BenchFrame& frame, std::vector<std::vector<std::uint32_t>>& lists,
                     double& bytes) {
    const Size size = frame.frame.size;
    resident.run();
    const BinReport report = resident.pass.impl().bins.read(size.width, size.height, &lists);
    bytes = static_cast<double>(report.bytes);
    const auto& rows = *std::get<DecalsLayer>(resident.scene.layers[0].bump).rows;
    const auto& order = resident.pass.impl().plan.tables[0].order;
    using namespace reference;
    std::vector<DecalBox<double>> boxes;
    std::vector<Projector> hard;
    for (auto& list : lists)
        for (std::uint32_t& number : list) number = order[number];
    for (const Projector& row : rows) {
        boxes.push_back(decal_box(from_array<double>(row.center), from_array<double>(row.axis_x),
                                  from_array<double>(row.axis_y), from_array<double>(row.half_size)));
        hard.push_back(row);
        hard.back().falloff = {0, 0, 0};
    }
    const auto rays = *pinhole_rays(frame.frame.camera, size);
    const auto& depth = frame.planes.at("depth");
    const std::uint32_t across = (size.width + 15) / 16;
    std::uint64_t inside = 0, touching = 0, entries = 0;
    for (std::size_t tile = 0; tile < lists.size(); ++tile) {
        std::vector<Vec<double>> points;
        const std::uint32_t x0 = static_cast<std::uint32_t>(tile) % across * 16,
                            y0 = static_cast<std::uint32_t>(tile) / across * 8;
        for (std::uint32_t y = y0; y < std::min(y0 + 8, size.height); ++y)
            for (std::uint32_t x = x0; x < std::min(x0 + 16, size.width); ++x) {
                const double z = depth[std::size_t{y} * size.width + x];
                if (!(z > 0 && z < 1e9)) continue;
                const auto part = [&](std::size_t k) {
                    return rays.eye[k] + z * (rays.d0[k] + rays.dx[k] * (x + 0.5) + rays.dy[k] * (y + 0.5));
                };
                points.push_back({part(0), part(1), part(2)});
            }
        entries += lists[tile].size();
        for (const std::uint32_t number : lists[tile]) {
            std::uint64_t count = 0;
            for (const Vec<double>& p : points) count += project(hard[number], boxes[number], p).weight > 0 ? 1 : 0;
            inside += count;
            touching += count > 0 ? 1 : 0;
        }
    }
    return {static_cast<double>(inside) / static_cast<double>(frame.pixels()),
            static_cast<double>(entries) / static_cast<double>(touching)};
}

std::map<std::filesystem::path, baseline::Image> images_of(const DecalsLayer& layer) {
    std::map<std::filesystem::path, baseline::Image> images;
    for (const TextureUse& use : layer.textures) {
        Image image = load_bump(use);
        images[use.file] = {image.width, image.height, image.channels, std::move(image.texels)};
    }
    return images;
}

/// Everything of one table that takes part in the race.
struct Entrant {
    DecalRow row;
    std::unique_ptr<Resident> resident;
    baseline::TileLists lists;
    std::unique_ptr<baseline::DecalTable> plain;
};

Entrant prepare(const Device& device, const BenchFrame& frame, const DecalMeasurement& wanted, std::size_t count) {
    Entrant e;
    const double pixels = static_cast<double>(frame.pixels());
    double half = std::sqrt(wanted.coverage * pixels / (2.5 * static_cast<double>(count)));
    for (int round = 0; round < 3; ++round) {  // until as many pixels are covered as wanted
        e.resident =
            std::make_unique<Resident>(device, scene_of(rows_of(frame, wanted, count, half)), frame, wanted.lanes);
        e.lists = {DecalBins::kTileWidth, DecalBins::kTileHeight, {}};
        const Coverage c = coverage_of(*e.resident, frame, e.lists.lists, e.row.bin_megabytes);
        e.row.coverage = c.per_pixel;
        e.row.listed = c.listed;
        if (std::abs(c.per_pixel / wanted.coverage - 1) < 0.02) break;
        half *= std::sqrt(wanted.coverage / c.per_pixel);
    }
    const auto& layer = std::get<DecalsLayer>(e.resident->scene.layers[0].bump);
    e.row.decals = layer.rows->size();
    e.row.name = fmt::format("{} decals of {:.0f} pixels", e.row.decals, 2 * half);
    e.row.bin_megabytes /= 1e6;
    if (wanted.plain)
        e.plain =
            std::make_unique<baseline::DecalTable>(layer, 1.0, frame.frame.size, frame.frame.camera, images_of(layer));
    return e;
}

}  // namespace

std::vector<DecalRow> measure_decals(const Device& device, const DecalMeasurement& wanted) {
    const BenchFrame frame = Resampler(load_scene(kData / "scenes/decals.toml")).frame(wanted.size);
    const std::size_t pixels = frame.pixels();
    std::vector<Entrant> entrants;
    for (const std::size_t count : wanted.counts) entrants.push_back(prepare(device, frame, wanted, count));
    Scene none = scene_of({});
    Resident empty(device, none, frame, wanted.lanes);
    Normals plain(pixels);
    const auto spans = frame.spans();

    std::ifstream text(WRINKLE_SOURCE_DIR "/bench/kernels/memory.cl");
    const BuiltProgram built =
        build_program(device, {std::istreambuf_iterator<char>(text), {}}, {device.info.lanes, false});
    cl::Kernel copy(built.program, "wr_copy");
    for (cl_uint i = 0; i < 3; ++i) {
        copy.setArg(i, empty.in.planes().at(fmt::format("normal.{}", "xyz"[i])));
        copy.setArg(i + 3, empty.out.planes().at(fmt::format("normal.{}", "xyz"[i])));
    }
    copy.setArg(6, static_cast<cl_uint>(pixels));
    const std::size_t items = (pixels / static_cast<std::size_t>(device.info.lanes) + 64) / 64 * 64;

    std::vector<Contender> contenders{{"empty", [&] { empty.run(); }}, {"copy", [&] {
                                                                            device.queue.enqueueNDRangeKernel(
                                                                                copy, cl::NullRange, cl::NDRange(items),
                                                                                cl::NDRange(64));
                                                                            device.queue.finish();
                                                                        }}};
    for (Entrant& e : entrants) {
        contenders.push_back({"pass", [&] { e.resident->run(); }});
        contenders.push_back({"bins", [&] { e.resident->bin(); }});
        contenders.push_back({"camera", [&] { e.resident->pass.set_camera(frame.frame.camera); }});
        if (e.plain)
            contenders.push_back({"plain", [&] {
                                      e.plain->run(e.resident->scene, spans, e.lists, {plain.x, plain.y, plain.z});
                                  }});
    }
    if (wanted.processor_time)
        race_on_processor(contenders, wanted.repetitions);
    else
        race(contenders, wanted.repetitions);
    std::vector<DecalRow> rows;
    std::size_t next = 2;
    for (Entrant& e : entrants) {
        e.row.empty = contenders[0].seconds;
        e.row.copy = contenders[1].seconds;
        e.row.pass = contenders[next++].seconds;
        e.row.bins = contenders[next++].seconds;
        e.row.camera = contenders[next++].seconds;
        if (e.plain) e.row.plain = contenders[next++].seconds;
        Normals got(pixels);
        e.resident->run();
        for (auto [name, plane] : {std::pair{"normal.x", &got.x}, {"normal.y", &got.y}, {"normal.z", &got.z}})
            std::memcpy(plane->data(), e.resident->out.map<float>(name, CL_MAP_READ), pixels * sizeof(float));
        e.resident->out.unmap();
        e.row.error = ReferenceSample(e.resident->scene, frame, kErrorSamples, 7).compare(got);
        rows.push_back(e.row);
    }
    return rows;
}

}  // namespace wrinkle::bench
