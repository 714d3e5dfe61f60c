#include "tools/render.h"

#include <sys/resource.h>

#include <algorithm>
#include <optional>

#include "device/guarded.h"
#include "layers/kinds.h"
#include "run/frame_run.h"
#include "run/open_frame.h"
#include "tools/frame_warnings.h"
#include "tools/scene_passes.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

PrecisionChoice everything_in(Precision precision, std::size_t layers) {
    if (precision == Precision::fp64) return {.fp64 = true};
    return {.precision = {precision, std::vector(layers, precision)}};
}

void add_new(std::vector<std::string>& lines, const std::vector<std::string>& more) {
    for (const std::string& line : more)
        if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
}

/// The frames of a run, one after another.
class FrameLoop {
public:
    FrameLoop(const Scene& scene, const RenderOptions& options)
        : options_(options),
          frames_(options.frames.empty() ? std::vector<int>{0} : options.frames),
          device_(clock_.measure(PhaseClock::build, [&] { return Device::open(options.device); })),
          store_(device_) {
        if (options.lanes != 0) device_.info.lanes = options.lanes;
        take(scene);
    }

    RenderReport run() {
        for (done_ = 0; done_ < frames_.size(); ++done_) render_frame(frames_[done_]);
        finish_report();
        return std::move(report_);
    }

private:
    /// What was made for another scene goes, but the textures that both have.
    void take(const Scene& scene) {
        MaskMatches matches(scene);
        if (!matches_ || !matches_->looks_for_the_same(matches)) {
            if (matches_) add_new(report_.warnings, matches_->warnings());
            matches_ = std::move(matches);
        }
        passes_.emplace(device_, scene, store_, clock_, report_);
    }

    void render_frame(int number) {
        if (options_.scene_of_frame) {
            take(clock_.measure(PhaseClock::read, [&] { return options_.scene_of_frame(number); }));
            store_.keep_latest();
        }
        const Scene& scene = passes_->scene();
        GBufferReader reader = clock_.measure(PhaseClock::read, [&] { return open_frame(scene, number); });
        const FrameCamera camera =
            clock_.measure(PhaseClock::read, [&] { return camera_of_frame(scene, reader, number); });
        report_.cameras.push_back(camera.origin + "; " + describe_residual(camera));
        add_new(report_.warnings, frame_warnings(scene, reader, camera));
        const Frame frame = frame_of(scene, reader, camera);
        std::optional<int> given;
        if (!options_.frames.empty()) given = number;
        check_outputs(scene, reader, options_.directory, given);
        matches_->begin(frame, reader.object_storage());
        evaluate(frame, reader, given);
        report_.pixels += std::uint64_t{frame.size.width} * frame.size.height;
        ++report_.frames;
    }

    /// Evaluates until the error budget is kept, if there is one, and only then gives the files their names.
    void evaluate(const Frame& frame, const GBufferReader& reader, std::optional<int> given) {
        const Scene& scene = passes_->scene();
        ScenePasses::Measured* const budget = passes_->budget(frame);
        for (bool done = false; !done;) {
            const PrecisionChoice how =
                budget != nullptr ? budget->budget.choice() : everything_in(options_.precision, scene.layers.size());
            FrameOutputs outputs(scene, passes_->pass(frame, how).impl(), reader, options_.directory, given);
            const double seconds = run(frame, reader, how, &outputs);
            done = budget == nullptr || budget->budget.accept(budget->sample.stats());
            if (done) {
                report_.kernels += seconds;
                clock_.measure(PhaseClock::write, [&] { outputs.finish(report_.files); });
            } else {
                budget->budget.raise(budget->sample.stats(), [&](const PrecisionChoice& choice) {
                    run(frame, reader, choice, nullptr);
                    return budget->sample.stats();
                });
            }
        }
    }

    /// Evaluates once; without outputs only to measure. Returns the seconds that kernels took.
    double run(const Frame& frame, const GBufferReader& reader, const PrecisionChoice& how, FrameOutputs* outputs) {
        Pass& pass = passes_->pass(frame, how);
        FrameRun run(pass.impl(), reader, clock_);
        run.match_masks(*matches_);
        if (outputs != nullptr) {
            run.write_to(*outputs);
            if (Condition* const condition = passes_->condition(frame)) run.add_condition(*condition);
            run.repeat(options_.repeat);
        }
        if (auto* const budget = passes_->budget(frame)) run.check_bands(budget->sample, frame.camera);
        const double seconds = run.run([&](double share) {
            if (options_.progress && outputs != nullptr)
                options_.progress((static_cast<double>(done_) + share) / static_cast<double>(frames_.size()));
        });
        clock_.measure(PhaseClock::build, [&] { pass.impl().save(); });
        return seconds;
    }

    void finish_report() {
        add_new(report_.warnings, store_.doubts());
        add_new(report_.warnings, matches_->warnings());
        if (passes_->last_budget()) report_.budget = passes_->last_budget()->budget.report();
        report_.device = device_.info;
        for (const Layer& layer : passes_->scene().layers)
            report_.layers += kind_of(layer_kinds(), layer).ends_stage ? 0 : 1;
        report_.read = clock_.seconds(PhaseClock::read);
        report_.build = clock_.seconds(PhaseClock::build) - report_.upload;
        report_.write = clock_.seconds(PhaseClock::write);
        report_.check = clock_.seconds(PhaseClock::check);
        report_.kernel_ns_per_pixel = report_.kernels / static_cast<double>(report_.pixels) * 1e9;
        report_.outside =
            clock_.outside({PhaseClock::read, PhaseClock::kernels, PhaseClock::check, PhaseClock::write});
        report_.wall = clock_.wall();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        report_.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    }

    const RenderOptions& options_;
    const std::vector<int> frames_;
    RenderReport report_;
    PhaseClock clock_;
    Device device_;
    TextureStore store_;
    std::optional<ScenePasses> passes_;
    std::optional<MaskMatches> matches_;
    std::size_t done_ = 0;
};

}  // namespace

RenderReport render(const Scene& scene, const RenderOptions& options) {
    return guarded("render", [&] { return FrameLoop(scene, options).run(); });
}

}  // namespace wrinkle
