#pragma once

#include <optional>

#include "budget/error_sample.h"
#include "run/condition.h"
#include "run/mask_matches.h"
#include "run/phase_clock.h"
#include "tools/render.h"

namespace wrinkle {

class [[gnu::visibility("hidden")]] ScenePasses;  // as hidden as the passes that it holds

/// What is made for a scene and then serves frame after frame of one shape: its passes, what measures its error budget,
/// its condition. What is made is told to the report.
class ScenePasses {
public:
    ScenePasses(const Device& device, Scene scene, TextureStore& store, PhaseClock& clock, RenderReport& report);

    const Scene& scene() const { return scene_; }

    /// An error budget with what measures it.
    struct Measured {
        Budget budget;
        ErrorSample sample;
    };

    /// The pass that computes a frame so.
    Pass& pass(const Frame& frame, const PrecisionChoice& how);
    /// Null where the scene has no budget.
    Measured* budget(const Frame& frame);
    /// Null where it is not wanted.
    Condition* condition(const Frame& frame);

    const std::optional<Measured>& last_budget() const { return measured_; }

private:
    const Device& device_;
    const Scene scene_;
    TextureStore& store_;
    PhaseClock& clock_;
    RenderReport& report_;
    std::optional<Pass> pass_;
    Frame pass_for_;
    PassOptions pass_with_;
    std::optional<Measured> measured_;
    std::optional<Condition> condition_;
    Frame condition_for_;
};

}  // namespace wrinkle
