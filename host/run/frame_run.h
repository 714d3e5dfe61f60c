#pragma once

#include <functional>

#include "io/gbuffer_reader.h"
#include "run/band_check.h"
#include "run/bands.h"
#include "run/condition.h"
#include "run/frame_outputs.h"
#include "run/mask_matches.h"
#include "run/phase_clock.h"

namespace wrinkle {

class [[gnu::visibility("hidden")]] FrameRun;  // as hidden as the pass that it holds

/// One frame in bands, several in flight: while one is evaluated others are read and written.
class FrameRun {
public:
    FrameRun(Pass::Impl& pass, const GBufferReader& reader, PhaseClock& clock);

    void write_to(FrameOutputs& outputs) { outputs_ = &outputs; }
    /// Starts the check, and shows it every band before that is written.
    void check_bands(BandCheck& check, const Camera& camera);
    /// Writes the condition of every pixel too.
    void add_condition(Condition& condition) { condition_ = &condition; }
    /// Shows every pixel to `matches`, which has begun this frame.
    void match_masks(MaskMatches& matches) { matches_ = &matches; }
    /// Enqueues the kernels this often, to time them.
    void repeat(int times) { repeat_ = times; }

    /// Returns the seconds kernels took.
    double run(const std::function<void(double)>& progress = {});

private:
    /// A band, and what of it only the host has.
    struct Slot : Band {
        std::map<std::string, std::vector<float>> passed{};    ///< planes that no kernel reads
        std::map<std::string, std::vector<float>> narrowed{};  ///< outputs of a pass in double
        std::vector<float> condition{};
    };

    void read(Slot& slot);
    void evaluate(Slot& slot);
    void write(Slot& slot);

    Pass::Impl& pass_;
    const GBufferReader& reader_;
    PhaseClock& clock_;
    BandGrid grid_;
    FrameOutputs* outputs_ = nullptr;
    BandCheck* check_ = nullptr;
    Condition* condition_ = nullptr;
    MaskMatches* matches_ = nullptr;
    int repeat_ = 1;
    std::vector<std::string> read_, passed_;  ///< planes that kernels read, and the others
    double kernel_seconds_ = 0;
};

}  // namespace wrinkle
