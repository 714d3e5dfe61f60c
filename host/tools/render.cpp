#include "tools/render.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

#include "budget/error_sample.h"
#include "device/guarded.h"
#include "layers/kinds.h"
#include "run/condition.h"
#include "run/frame_run.h"
#include "run/open_frame.h"
#include "tools/frame_lights.h"
#include "tools/frame_warnings.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Makes the passes of a run, and keeps the last one while frames fit it.
class Passes {
public:
    Passes(const Device& device, const Scene& scene, TextureStore& store, PhaseClock& clock, RenderReport& report)
        : device_(device), scene_(scene), store_(store), clock_(clock), report_(report) {}

    Pass& get(const Frame& frame, const PassOptions& options) {
        if (pass_ && same_shape(frame, built_for_) && options.fp64 == built_with_.fp64 &&
            options.precision == built_with_.precision) {
            pass_->set_camera(frame.camera);
            return *pass_;
        }
        pass_.emplace(
            clock_.measure(PhaseClock::build, [&] { return evaluate(device_, scene_, frame, options, &store_); }));
        report_.upload += pass_->impl().texture_seconds;
        report_.cache_hit = pass_->impl().built.source == BuildSource::disk;
        built_for_ = frame, built_with_ = options;
        return *pass_;
    }

private:
    const Device& device_;
    const Scene& scene_;
    TextureStore& store_;
    PhaseClock& clock_;
    RenderReport& report_;
    std::optional<Pass> pass_;
    Frame built_for_;
    PassOptions built_with_;
};

/// A budget with what measures it on the frames of one shape.
struct KeptBudget {
    Budget budget;
    ErrorSample sample;
};

PrecisionChoice everything_in(Precision precision, std::size_t layers) {
    if (precision == Precision::fp64) return {.fp64 = true};
    return {.precision = {precision, std::vector(layers, precision)}};
}

PassOptions options_of(const PrecisionChoice& choice) {
    PassOptions options{.fp64 = choice.fp64};
    if (!choice.fp64) options.precision = choice.precision;
    return options;
}

RenderReport render_frames(const Scene& given, const RenderOptions& options) {
    RenderReport report;
    PhaseClock clock;
    const std::vector<int> frames = options.frames.empty() ? std::vector<int>{0} : options.frames;
    std::optional<Scene> lit;
    if (wants_lights(given)) {  // those of the first frame for all: lights that are fitted anew would flicker
        const FrameLights fitted = clock.measure(PhaseClock::read, [&] { return lights_of_frame(given, frames[0]); });
        report.lights = summary(fitted);
        lit = with_lights(given, fitted);
    }
    const Scene& scene = lit ? *lit : given;
    Device device = clock.measure(PhaseClock::build, [&] { return Device::open(options.device); });
    if (options.lanes != 0) device.info.lanes = options.lanes;
    TextureStore store(device);
    Passes passes(device, scene, store, clock, report);
    std::optional<KeptBudget> kept;
    std::optional<Condition> condition;
    Frame condition_for;
    MaskMatches matches(scene);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        GBufferReader reader = clock.measure(PhaseClock::read, [&] { return open_frame(scene, frames[f]); });
        const FrameCamera camera =
            clock.measure(PhaseClock::read, [&] { return camera_of_frame(scene, reader, frames[f]); });
        report.cameras.push_back(camera.origin + "; " + describe_residual(camera));
        for (const std::string& line : frame_warnings(scene, reader, camera))
            if (std::ranges::find(report.warnings, line) == report.warnings.end()) report.warnings.push_back(line);
        const Frame frame = frame_of(scene, reader, camera);
        std::optional<int> number;
        if (!options.frames.empty()) number = frames[f];
        check_outputs(scene, reader, options.directory, number);
        matches.begin(frame, reader.object_storage());
        if (scene.budget.max_error && !(kept && kept->sample.fits(frame)))
            kept.emplace(clock.measure(PhaseClock::build, [&] {
                return KeptBudget{Budget(scene, camera_kind(frame.camera, frame.size), costs_of(device.info)),
                                  ErrorSample(device, scene, frame, scene.budget, &store)};
            }));
        if (scene.output.condition) {
            if (!condition || !same_shape(frame, condition_for))
                condition.emplace(
                    clock.measure(PhaseClock::build, [&] { return Condition(device, scene, frame, &store); }));
            condition_for = frame;
            condition->set_camera(frame.camera);
        }
        const auto evaluated = [&](const PassOptions& how, FrameOutputs* outputs) {
            Pass& pass = passes.get(frame, how);
            FrameRun run(pass.impl(), reader, clock);
            run.match_masks(matches);
            if (outputs != nullptr) {
                run.write_to(*outputs);
                if (condition) run.add_condition(*condition);
                run.repeat(options.repeat);
            }
            if (kept) run.check_bands(kept->sample, frame.camera);
            const double seconds = run.run([&](double share) {
                if (options.progress && outputs != nullptr)
                    options.progress((static_cast<double>(f) + share) / static_cast<double>(frames.size()));
            });
            clock.measure(PhaseClock::build, [&] { pass.impl().save(); });
            return seconds;
        };
        for (bool done = false; !done;) {
            const PassOptions how =
                options_of(kept ? kept->budget.choice() : everything_in(options.precision, scene.layers.size()));
            FrameOutputs outputs(scene, passes.get(frame, how).impl(), reader, options.directory, number);
            const double seconds = evaluated(how, &outputs);
            done = !kept || kept->budget.accept(kept->sample.stats());
            if (done) {
                report.kernels += seconds;
                clock.measure(PhaseClock::write, [&] { outputs.finish(report.files); });
            } else {
                kept->budget.raise(kept->sample.stats(), [&](const PrecisionChoice& choice) {
                    evaluated(options_of(choice), nullptr);
                    return kept->sample.stats();
                });
            }
        }
        report.pixels += std::uint64_t{frame.size.width} * frame.size.height;
        ++report.frames;
    }
    report.warnings.insert(report.warnings.end(), store.doubts().begin(), store.doubts().end());
    const auto unmatched = matches.warnings();
    report.warnings.insert(report.warnings.end(), unmatched.begin(), unmatched.end());
    if (kept) report.budget = kept->budget.report();
    report.device = device.info;
    for (const Layer& layer : scene.layers) report.layers += kind_of(layer_kinds(), layer).ends_stage ? 0 : 1;
    report.read = clock.seconds(PhaseClock::read);
    report.build = clock.seconds(PhaseClock::build) - report.upload;
    report.write = clock.seconds(PhaseClock::write);
    report.check = clock.seconds(PhaseClock::check);
    report.kernel_ns_per_pixel = report.kernels / static_cast<double>(report.pixels) * 1e9;
    report.outside = clock.outside({PhaseClock::read, PhaseClock::kernels, PhaseClock::check, PhaseClock::write});
    report.wall = clock.wall();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    report.peak_memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
    return report;
}

}  // namespace

RenderReport render(const Scene& scene, const RenderOptions& options) {
    return guarded("render", [&] { return render_frames(scene, options); });
}

}  // namespace wrinkle
