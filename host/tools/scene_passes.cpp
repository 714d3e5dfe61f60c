#include "tools/scene_passes.h"

namespace wrinkle {
namespace {

PassOptions options_of(const PrecisionChoice& choice) {
    PassOptions options{.fp64 = choice.fp64};
    if (!choice.fp64) options.precision = choice.precision;
    return options;
}

}  // namespace

ScenePasses::ScenePasses(const Device& device, Scene scene, TextureStore& store, PhaseClock& clock,
                         RenderReport& report)
    : device_(device), scene_(std::move(scene)), store_(store), clock_(clock), report_(report) {}

Pass& ScenePasses::pass(const Frame& frame, const PrecisionChoice& how) {
    const PassOptions options = options_of(how);
    if (pass_ && same_shape(frame, pass_for_) && options.fp64 == pass_with_.fp64 &&
        options.precision == pass_with_.precision) {
        pass_->set_camera(frame.camera);
        return *pass_;
    }
    pass_.emplace(
        clock_.measure(PhaseClock::build, [&] { return evaluate(device_, scene_, frame, options, &store_); }));
    report_.upload += pass_->impl().texture_seconds;
    report_.cache_hit = pass_->impl().built.source == BuildSource::disk;
    pass_for_ = frame, pass_with_ = options;
    return *pass_;
}

ScenePasses::Measured* ScenePasses::budget(const Frame& frame) {
    if (!scene_.budget.max_error) return nullptr;
    if (!measured_ || !measured_->sample.fits(frame))
        measured_.emplace(clock_.measure(PhaseClock::build, [&] {
            return Measured{Budget(scene_, camera_kind(frame.camera, frame.size), costs_of(device_.info)),
                            ErrorSample(device_, scene_, frame, scene_.budget, &store_)};
        }));
    return &*measured_;
}

Condition* ScenePasses::condition(const Frame& frame) {
    if (!scene_.output.condition) return nullptr;
    if (!condition_ || !same_shape(frame, condition_for_))
        condition_.emplace(
            clock_.measure(PhaseClock::build, [&] { return Condition(device_, scene_, frame, &store_); }));
    condition_for_ = frame;
    condition_->set_camera(frame.camera);
    return &*condition_;
}

}  // namespace wrinkle
