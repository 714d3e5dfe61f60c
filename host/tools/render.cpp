#include "tools/render.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "device/guarded.h"
#include "layers/kinds.h"
#include "run/frame_run.h"
#include "tools/frames_ahead.h"
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

/// What frames are evaluated on. It is made for the first one that has to be.
struct OpenDevice {
    OpenDevice(Device opened) : device(std::move(opened)), store(device) {}

    Device device;
    TextureStore store;
};

/// The frames of a run, one after another.
class FrameLoop {
public:
    FrameLoop(const Scene& scene, const RenderOptions& options)
        : scene_(scene), options_(options), frames_(options.frames.empty() ? std::vector<int>{0} : options.frames) {}

    RenderReport run() {
        for (done_ = 0; done_ < frames_.size(); ++done_) {
            FrameReport frame{.frame = frames_[done_]};
            const auto start = PhaseClock::Clock::now();
            try {
                guarded("render", [&] { frame.state = render_frame(frame); });
            } catch (const Error& error) {
                if (!options_.keep_going) throw;
                frame.state = FrameReport::State::failed;
                frame.error = error.what();
                report_.failed.push_back(frame);
                passes_.reset();  // whatever state they are in
            }
            frame.seconds = std::chrono::duration<double>(PhaseClock::Clock::now() - start).count();
            report_.files.insert(report_.files.end(), frame.files.begin(), frame.files.end());
            if (options_.frame_done) options_.frame_done(frame);
        }
        finish_report();
        return std::move(report_);
    }

private:
    void open_device() {
        if (on_) return;
        Device device = clock_.measure(PhaseClock::build, [&] { return Device::open(options_.device); });
        if (options_.lanes != 0) device.info.lanes = options_.lanes;
        on_.emplace(std::move(device));
        report_.device = on_->device.info;
    }

    /// What was made for another scene goes, but the textures that both have.
    void take(Scene scene) {
        if (scene.budget.max_area_error) scene.filter.taps = taps_of_run().taps;
        MaskMatches matches(scene);
        if (!matches_ || !matches_->looks_for_the_same(matches)) {
            if (matches_) add_new(report_.warnings, matches_->warnings());
            matches_ = std::move(matches);
        }
        passes_.emplace(on_->device, std::move(scene), on_->store, clock_, report_);
    }

    /// One number for all frames, as a sequence would show where it changes: the one of the first, also where that is
    /// done already.
    const TapsChoice& taps_of_run() {
        if (!report_.taps)
            report_.taps = clock_.measure(PhaseClock::check, [&] {
                const int first = frames_.front();
                return choose_taps(options_.scene_of_frame ? options_.scene_of_frame(first) : scene_, first,
                                   options_.device);
            });
        return *report_.taps;
    }

    FrameReport::State render_frame(FrameReport& report) {
        const bool last = done_ + 1 == frames_.size();
        FrameAhead ahead = ahead_.take(report.frame, last ? std::nullopt : std::optional(frames_[done_ + 1]));
        if (!ahead.open) {
            ++report_.skipped;
            return FrameReport::State::skipped;
        }
        open_device();
        report_.lights = ahead.lights;
        if (!passes_ || ahead.scene != latest_) {
            latest_ = ahead.scene;
            take(*ahead.scene);
            on_->store.keep_latest();
        }
        report_.cameras.push_back(ahead.open->camera);
        warn(ahead.open->warnings);
        const Frame& frame = ahead.open->frame;
        matches_->begin(frame, ahead.open->reader.object_storage());
        evaluate(frame, ahead.open->reader, ahead.provenance, report);
        report_.pixels += std::uint64_t{frame.size.width} * frame.size.height;
        ++report_.frames;
        return FrameReport::State::written;
    }

    void warn(const std::vector<std::string>& warnings) {
        if (options_.strict && !warnings.empty()) throw Error(warnings.front() + " (--strict)");
        add_new(report_.warnings, warnings);
    }

    /// Evaluates until the error budget is kept, if there is one, and only then gives the files their names.
    void evaluate(const Frame& frame, const GBufferReader& reader, const std::string& provenance, FrameReport& report) {
        const Scene& scene = passes_->scene();
        ScenePasses::Measured* const budget = passes_->budget(frame);
        for (bool done = false; !done;) {
            const PrecisionChoice how =
                budget != nullptr ? budget->budget.choice() : everything_in(options_.precision, scene.layers.size());
            Pass& pass = passes_->pass(frame, how);
            warn(on_->store.doubts());
            FrameOutputs outputs(scene, pass.impl(), reader, options_.directory,
                                 options_.frames.empty() ? std::nullopt : std::optional(report.frame), provenance);
            const double seconds = run(frame, reader, how, &outputs);
            done = budget == nullptr || budget->budget.accept(budget->sample.stats());
            if (done) {
                report_.kernels += seconds;
                clock_.measure(PhaseClock::write, [&] { outputs.finish(report.files); });
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
        if (matches_) add_new(report_.warnings, matches_->warnings());
        if (passes_ && passes_->last_budget()) report_.budget = passes_->last_budget()->budget.report();
        for (const Layer& layer : scene_.layers) report_.layers += kind_of(layer_kinds(), layer).ends_stage ? 0 : 1;
        report_.read = clock_.seconds(PhaseClock::read);
        report_.build = clock_.seconds(PhaseClock::build) - report_.upload;
        report_.write = clock_.seconds(PhaseClock::write);
        report_.check = clock_.seconds(PhaseClock::check);
        report_.kernel_ns_per_pixel =
            report_.pixels == 0 ? 0 : report_.kernels / static_cast<double>(report_.pixels) * 1e9;
        report_.outside = clock_.outside({PhaseClock::read, PhaseClock::kernels, PhaseClock::check, PhaseClock::write});
        report_.wall = clock_.wall();
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        report_.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    }

    const Scene& scene_;  ///< that of any frame, where they differ
    const RenderOptions& options_;
    const std::vector<int> frames_;
    RenderReport report_;
    PhaseClock clock_;
    std::optional<OpenDevice> on_;
    std::shared_ptr<const Scene> latest_;
    std::optional<ScenePasses> passes_;
    std::optional<MaskMatches> matches_;
    std::size_t done_ = 0;
    FramesAhead ahead_{scene_, options_, clock_};
};

}  // namespace

RenderReport render(const Scene& scene, const RenderOptions& options) {
    return guarded("render", [&] { return FrameLoop(scene, options).run(); });
}

}  // namespace wrinkle
