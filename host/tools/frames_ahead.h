#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/gbuffer_reader.h"
#include "run/phase_clock.h"
#include "tools/frame_lights.h"
#include "tools/metal_pictures.h"
#include "tools/render.h"

namespace wrinkle {

/// A frame that is open: all that is asked of its file before its pixels are read.
struct OpenFrame {
    Frame frame;
    GBufferReader reader;
    std::string camera;  ///< where it is from, and how well it fits
    std::vector<std::string> warnings;
};

/// What is known of a frame before a device is needed.
struct FrameAhead {
    std::string provenance;
    std::shared_ptr<const Scene> scene;  ///< the one of the frame before it, unless frames' scenes differ
    std::string lights;                  ///< of those that were fitted
    std::optional<OpenFrame> open;       ///< nothing: its files are there already
};

/// Opens the frames of a run and has the system fetch them, each while the one before it is evaluated.
class FramesAhead {
public:
    FramesAhead(const Scene& scene, const RenderOptions& options, PhaseClock& clock)
        : scene_(scene), options_(options), clock_(clock) {}

    /// The frame of this number. Begins to open the one of `next`, for the call after this. Throws Error.
    FrameAhead take(int number, std::optional<int> next);

private:
    FrameAhead open(int number);
    bool is_finished(int number, const std::string& provenance) const;
    std::shared_ptr<const Scene> scene_of(int number);
    std::shared_ptr<const Scene> lit(const Scene& scene);
    std::shared_ptr<const Scene> with_metals_of(int number, std::shared_ptr<const Scene> scene);

    const Scene& scene_;  ///< that of any frame, where they differ
    const RenderOptions& options_;
    PhaseClock& clock_;
    // Used by open() alone, which never runs twice at a time.
    std::shared_ptr<const Scene> shared_;
    std::optional<FoundLights> lights_;
    MetalPictures metals_;
    std::future<FrameAhead> next_;  // last: the others have to outlive what it waits for
};

}  // namespace wrinkle
