#include "budget/tune.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/folder_lock.h"
#include "budget/choose_precision.h"
#include "budget/error_sample.h"
#include "device/guarded.h"
#include "layers/kinds.h"
#include "run/frame_run.h"
#include "run/open_frame.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// What the layers of a kind that were measured so far cost on average, and err by at most.
struct Measured {
    VariantCost cost;
    int layers = 0;

    void add(const VariantCost& one) {
        cost.ns = (cost.ns * layers + one.ns) / (layers + 1);
        cost.p99 = std::max(cost.p99, one.p99), cost.max = std::max(cost.max, one.max);
        ++layers;
    }
};

class Tuner {
public:
    Tuner(const Device& device, const TuneOptions& options) : device_(device), options_(options), store_(device) {}

    void measure(const Scene& from_file) {
        scene_ = from_file;
        store_ = TextureStore(device_);  // of one scene at a time
        scene_.lighting = {};
        scene_.output = {};
        reader_.emplace(open_frame(scene_, 0));
        frame_ = frame_of(scene_, *reader_, camera_of_frame(scene_, *reader_, 0, CameraCheck::none));
        kind_ = camera_kind(frame_.camera, frame_.size);
        say("nothing but the frame");
        const Scene empty = with({});
        empty_ = time(empty, {}, nullptr), empty_in_double_ = time(empty, {.fp64 = true}, nullptr);
        for (std::size_t i = 0; i < scene_.layers.size(); ++i)
            if (!kind_of(layer_kinds(), scene_.layers[i]).ends_stage) measure_layer(i);
        measure_geometry();
    }

    std::map<std::string, std::map<Precision, VariantCost>> kinds() const {
        std::map<std::string, std::map<Precision, VariantCost>> out;
        for (const auto& [kind, variants] : measured_)
            for (const auto& [precision, measured] : variants) out[kind][precision] = measured.cost;
        return out;
    }

private:
    Scene with(std::vector<Layer> layers) const {
        Scene scene = scene_;
        scene.layers = std::move(layers);
        return scene;
    }

    void say(const std::string& what) const {
        if (options_.progress) options_.progress(fmt::format("{}: {}", scene_.file.filename().string(), what));
    }

    /// Nanoseconds a pixel.
    double time(const Scene& scene, const PassOptions& how, ErrorSample* sample) {
        Pass pass = evaluate(device_, scene, frame_, how, &store_);
        PhaseClock clock;
        FrameRun run(pass.impl(), *reader_, clock);
        run.repeat(options_.repeat);
        if (sample != nullptr) run.check_bands(*sample, frame_.camera);
        const double seconds = run.run();
        pass.impl().save();
        return seconds * 1e9 / (static_cast<double>(frame_.size.width) * frame_.size.height);
    }

    ErrorSample sample_of(const Scene& scene) {
        return {device_, scene, frame_, {.max_error = {}, .sample = options_.sample, .seed = options_.seed}, &store_};
    }

    void measure_layer(std::size_t index) {
        say(fmt::format("layer \"{}\"", scene_.layers[index].name));
        Scene alone = with({scene_.layers[index]});
        alone.layers.front().mask = {};  // what it costs and errs where it is
        const CostKind kind = cost_kind(layer_kinds(), scene_.layers[index]);
        ErrorSample sample = sample_of(alone);
        for (const Precision precision : layer_precisions(layer_kinds(), alone, 0, kind_)) {
            const double ns = time(alone, {.precision = {.layers = {precision}}}, &sample);
            add(kind, precision, ns - empty_, sample.stats());
        }
        const double in_double = time(alone, {.fp64 = true}, &sample);
        add(kind, Precision::fp64, in_double - empty_in_double_, sample.stats());
    }

    /// The time of the geometry is that of screen derivatives alone. Its error shows in normals only: it is how much
    /// more the scene errs than with the most exact geometry.
    void measure_geometry() {
        say("the geometry");
        Scene derivatives = with({});
        derivatives.output.dp_dx = derivatives.output.dp_dy = true;
        ErrorSample sample = sample_of(scene_);
        Precisions all{.layers = std::vector(scene_.layers.size(), Precision::exact)};
        ErrorStats least;
        const std::vector<Precision> ladder = geometry_precisions();
        for (auto precision = ladder.rbegin(); precision != ladder.rend(); ++precision) {
            all.geometry = *precision;
            time(scene_, {.precision = all}, &sample);
            ErrorStats stats = sample.stats();
            if (precision == ladder.rbegin()) least = stats;
            stats.p99 = std::max(stats.p99 - least.p99, 0.0), stats.max = std::max(stats.max - least.max, 0.0);
            add({kGeometryKind}, *precision,
                time(derivatives, {.precision = {.geometry = *precision}}, nullptr) - empty_, stats);
        }
        add({kGeometryKind}, Precision::fp64, time(derivatives, {.fp64 = true}, nullptr) - empty_in_double_, {});
    }

    void add(const CostKind& kind, Precision precision, double ns, const ErrorStats& stats) {
        if (stats.not_finite > 0)
            throw Error(fmt::format("{}: {} {} gave normals that are not finite", scene_.file.string(), kind.name,
                                    precision_name(precision)));
        measured_[kind.name][precision].add({std::max(ns, 0.0) / kind.units, stats.p99, stats.max});
    }

    const Device& device_;
    const TuneOptions& options_;
    TextureStore store_;
    Scene scene_;
    Frame frame_;
    CameraKind kind_ = CameraKind::pinhole;
    std::optional<GBufferReader> reader_;
    double empty_ = 0, empty_in_double_ = 0;
    std::map<std::string, std::map<Precision, Measured>> measured_;
};

}  // namespace

DeviceCosts measure_costs(const Device& device, const std::vector<Scene>& scenes, const TuneOptions& options) {
    return guarded("tune", [&] {
        Tuner tuner(device, options);
        for (const Scene& scene : scenes) tuner.measure(scene);
        return DeviceCosts{device_class(device.info), device.info.name, device.info.driver, tuner.kinds(), {}};
    });
}

void merge_costs(const std::filesystem::path& file, const DeviceCosts& measured) {
    const FolderLock lock(file.parent_path());  // else, of two that measure at once, one would lose its rows
    std::vector<DeviceCosts> tables = read_costs(file);
    const auto same = std::ranges::find_if(tables, [&](const DeviceCosts& table) {
        return table.device == measured.device && table.driver == measured.driver &&
               table.device_class == measured.device_class;
    });
    if (same == tables.end())
        tables.push_back(measured);
    else {
        for (const auto& [kind, variants] : measured.kinds) same->kinds[kind] = variants;
        for (const auto& [kind, rows] : measured.areas) same->areas[kind] = rows;
    }
    write_costs(file, tables);
}

}  // namespace wrinkle
