#include "decals.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "baseline/decals.h"
#include "resident.h"
#include "run/pass_impl.h"
#include "temporary_folder.h"
#include "tests/reference/projector.h"
#include "tools/scatter.h"

#include "layout.h"

namespace wrinkle::bench {

namespace {

constexpr std::size_t kDecalSamples = 256;  // few, since the reference evaluates every decal at every one of them
constexpr double kCoverage = 8;             // decals that a pixel lies in, on average

struct Wanted {
    std::size_t count;
    bool replace, plain;
};
const std::filesystem::path kData = WRINKLE_SOURCE_DIR "/data";

Scene scene_of(std::vector<Projector> rows) {
    Scene scene = load_scene(kData / "scenes/decals.toml");
    scene.lighting = {};
    scene.filter.taps = 1;
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

std::vector<Projector> rows_of(const BenchFrame& frame, const Wanted& wanted, double half_size) {
    ScatterOptions options;
    options.count = wanted.count;
    options.pixels = true;
    options.spacing = 0.25 * half_size;
    options.half_size = {half_size, half_size};
    options.textures = 3;
    options.mode = wanted.replace ? ProjectorMode::replace : ProjectorMode::add;
    options.opacity = wanted.replace ? 0.7 : 1;
    return scatter_decals(options, frame.frame, frame.spans());
}

/// A resident pass with its scene, whose bins can be made by themselves.
struct BinnedPass {
    Scene scene;
    Resident resident;

    BinnedPass(const Device& device, Scene given, const BenchFrame& frame)
        : scene(std::move(given)), resident(device, scene, frame) {}
    void bin() {
        Pass::Impl& impl = resident.pass.impl();
        std::vector<cl::Buffer> planes;
        for (const std::string& name : impl.plan.tiles->inputs) planes.push_back(resident.in.planes().at(name));
        impl.bins
            .enqueue(impl.frame, impl.numbers, planes, {.first = 0, .count = impl.size.height}, impl.size.width, 0,
                     impl.size.width * impl.size.height, {})
            .wait();
    }
};

/// How often pixels are covered, and how much longer the tiles' lists are than they would have to be.
struct Coverage {
    double per_pixel = 0;  ///< decals that a pixel lies in
    double listed = 0;     ///< entries of the tiles' lists, for each pair of a tile and a decal that touch
    double bytes = 0;      ///< tables, bounds and lists on the device
};

Coverage coverage_of(BinnedPass& decals, const BenchFrame& frame, std::vector<std::vector<std::uint32_t>>& lists) {
    const Size size = frame.frame.size;
    decals.resident.run();
    const BinReport report = decals.resident.pass.impl().bins.read(size.width, size.height, &lists);
    const auto& rows = *std::get<DecalsLayer>(decals.scene.layers[0].bump).rows;
    const auto& order = decals.resident.pass.impl().plan.tables[0].order;
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
            static_cast<double>(entries) / static_cast<double>(touching), static_cast<double>(report.bytes)};
}

/// One table of decals with all that the race needs of it.
struct Entrant {
    std::string name;
    Coverage coverage;
    std::unique_ptr<BinnedPass> decals;
    baseline::TileLists lists;
    std::unique_ptr<baseline::DecalTable> plain;
    std::size_t first = 0;  ///< number of its first contender
};

Entrant prepare(const Device& device, const BenchFrame& frame, const Wanted& wanted) {
    Entrant e;
    double half =
        std::sqrt(kCoverage * static_cast<double>(frame.pixels()) / (2.5 * static_cast<double>(wanted.count)));
    for (int round = 0; round < 3; ++round) {  // until as many pixels are covered as wanted
        e.decals = std::make_unique<BinnedPass>(device, scene_of(rows_of(frame, wanted, half)), frame);
        e.lists = {WR_TILE_WIDTH, WR_TILE_HEIGHT, {}};
        e.coverage = coverage_of(*e.decals, frame, e.lists.lists);
        if (std::abs(e.coverage.per_pixel / kCoverage - 1) < 0.02) break;
        half *= std::sqrt(kCoverage / e.coverage.per_pixel);
    }
    const auto& layer = std::get<DecalsLayer>(e.decals->scene.layers[0].bump);
    e.name = fmt::format("{} decals{}", wanted.count, wanted.replace ? " that replace" : "");
    if (wanted.plain)
        e.plain = std::make_unique<baseline::DecalTable>(layer, 1.0, frame.frame.size, frame.frame.camera,
                                                         baseline_images(e.decals->scene));
    return e;
}

/// Seconds a pixel that a copy of one plane takes at the ceiling of the run.
double copy_seconds(const Run& run) { return 2 * sizeof(float) / (run.ceilings.copy_gb_s * 1e9); }

/// Seconds to load the table from a file with this ending, which parses and checks every row. The median of five.
double seconds_to_load(const Entrant& e, const char* ending) {
    const TemporaryFolder folder;
    const auto file = folder.path() / fmt::format("decals.{}", ending);
    const auto& layer = std::get<DecalsLayer>(e.decals->scene.layers[0].bump);
    save_decals(file, *layer.rows);
    std::vector<Contender> loads{{ending, [&] { load_decals(file, layer.textures.size()); }}};
    race(loads, {5});
    return loads[0].seconds.median;
}

}  // namespace

void measure_decals(const Device& device, Size size, bool quick, Run& run) {
    const BenchFrame frame = Resampler(load_scene(kData / "scenes/decals.toml")).frame(size);
    const std::size_t pixels = frame.pixels();
    std::vector<Wanted> tables{{1000, false, !quick}, {10'000, false, false}};
    if (!quick) tables.insert(tables.end(), {{100'000, false, true}, {100'000, true, false}});
    std::vector<Entrant> entrants;
    for (const Wanted& wanted : tables) entrants.push_back(prepare(device, frame, wanted));
    Resident empty(device, scene_of({}), frame);
    Normals plain(pixels);
    const auto spans = frame.spans();

    std::vector<Contender> contenders{{"", [&] { empty.run(); }}};
    for (Entrant& e : entrants) {
        e.first = contenders.size();
        contenders.push_back({"standard", [&] { e.decals->resident.run(); }});
        contenders.push_back({"binning alone", [&] { e.decals->bin(); }});
        contenders.push_back(
            {"new camera, on the host", [&] { e.decals->resident.pass.set_camera(frame.frame.camera); }});
        if (e.plain)
            contenders.push_back({"plain C++, same lists", [&] {
                                      e.plain->run(e.decals->scene, spans, e.lists, {plain.x, plain.y, plain.z});
                                  }});
    }
    race(contenders, run.rounds);

    for (Entrant& e : entrants) {
        const ReferenceSample reference(e.decals->scene, frame, kDecalSamples, 7);
        e.decals->resident.run();
        const Normals got = e.decals->resident.normals(pixels);
        const Plan& plan = e.decals->resident.pass.impl().plan;
        const ErrorStats error = reference.compare(got);
        const double covered = e.coverage.per_pixel * static_cast<double>(pixels);
        const auto per_decal = [&](const Timing& t) {  // seconds, above the pass without decals
            return (t.median - contenders[0].seconds.median) / covered;
        };
        for (std::size_t i = e.first; i < e.first + (e.plain ? 4 : 3); ++i) {
            const bool kernel = i < e.first + 2, whole = i == e.first || i == e.first + 3;
            Measurement m = measured("decals", e.name, contenders[i], kernel ? device.info.lanes : 0, pixels);
            m.bytes = whole ? plan.bytes : 0;
            m.operations = whole ? operations_of(e.decals->resident.pass) * e.coverage.per_pixel : 0;
            m.at_most = true;
            m.error = error;
            if (i == e.first + 3) {
                contenders[i].work();
                m.error = reference.compare(plain);
            }
            if (whole) m.figures["ns a decal and pixel"] = 1e9 * per_decal(m.seconds);
            if (i == e.first) {
                m.hash = hash_of(got.x.data(), pixels * sizeof(float));
                m.figures["copies of a plane, a decal and pixel"] = per_decal(m.seconds) / copy_seconds(run);
                m.figures["decals a pixel"] = e.coverage.per_pixel;
                m.figures["entries for each that touches"] = e.coverage.listed;
                m.figures["MB of tables and lists"] = e.coverage.bytes / 1e6;
                for (const char* ending : {"csv", "toml"})
                    m.figures[fmt::format("s to load from .{}", ending)] = seconds_to_load(e, ending);
            }
            run.measurements.push_back(std::move(m));
        }
    }
}

}  // namespace wrinkle::bench
