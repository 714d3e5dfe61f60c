#include "tools/frames_ahead.h"

#include <algorithm>

#include "io/provenance.h"
#include "run/frame_outputs.h"
#include "run/open_frame.h"
#include "run/output_names.h"
#include "tools/frame_warnings.h"

namespace wrinkle {

namespace {

std::optional<int> given(const RenderOptions& options, int number) {
    return options.frames.empty() ? std::nullopt : std::optional(number);
}

}  // namespace

FrameAhead FramesAhead::take(int number, std::optional<int> next) {
    const auto begin_next = [&] {
        if (next) next_ = std::async(std::launch::async, [this, next] { return open(*next); });
    };
    if (!next_.valid()) next_ = std::async(std::launch::deferred, [this, number] { return open(number); });
    std::optional<FrameAhead> frame;
    try {
        frame.emplace(next_.get());
    } catch (...) {
        if (options_.keep_going) begin_next();
        throw;
    }
    begin_next();
    return std::move(*frame);
}

bool FramesAhead::is_finished(int number, const std::string& provenance) const {
    const auto files = OutputNames(scene_, options_.directory, given(options_, number)).all();
    return std::ranges::all_of(files, [&](const auto& file) { return io::is_finished(file, provenance); });
}

/// With lights fitted to the picture, where the scene wants some: those of the first frame for all of them, as lights
/// that are fitted anew would flicker.
std::shared_ptr<const Scene> FramesAhead::lit(const Scene& scene) {
    if (!wants_lights(scene)) return std::make_shared<const Scene>(scene);
    if (!lights_) lights_ = find_lights(scene, options_.frames.empty() ? 0 : options_.frames.front());
    return std::make_shared<const Scene>(with_lights(scene, *lights_));
}

std::shared_ptr<const Scene> FramesAhead::scene_of(int number) {
    if (options_.scene_of_frame) return lit(options_.scene_of_frame(number));
    if (!shared_) shared_ = lit(scene_);
    return shared_;
}

/// With what its metals mirror: of the objects that the first frame has.
std::shared_ptr<const Scene> FramesAhead::with_metals_of(int number, std::shared_ptr<const Scene> scene) {
    if (!wants_metals(*scene)) return scene;
    const int first = options_.frames.empty() ? number : options_.frames.front();
    if (!metals_ && number != first) metals_ = metals_of_frame(*scene, first);  // where that is finished already
    if (!metals_ || !metals_->empty()) metals_ = metals_of_frame(*scene, number, metals_);
    if (!metals_) metals_ = std::make_shared<const std::vector<MetalPicture>>();
    return metals_->empty() ? scene : std::make_shared<const Scene>(with_metals(*scene, metals_));
}

FrameAhead FramesAhead::open(int number) {
    FrameAhead ahead;
    if (options_.provenance) ahead.provenance = options_.provenance(number);
    if (options_.resume && is_finished(number, ahead.provenance)) return ahead;
    clock_.measure(PhaseClock::read, [&] {
        ahead.scene = with_metals_of(number, scene_of(number));
        if (lights_) ahead.lights = summary(*lights_);
        GBufferReader reader = open_frame(*ahead.scene, number);
        reader.read_ahead();
        const FrameCamera camera = camera_of_frame(*ahead.scene, reader, number);
        check_outputs(*ahead.scene, reader, options_.directory, given(options_, number));
        ahead.open = OpenFrame{.frame = frame_of(*ahead.scene, reader, camera),
                               .reader = std::move(reader),
                               .camera = camera.origin + "; " + describe_residual(camera),
                               .warnings = {}};
        ahead.open->warnings = frame_warnings(*ahead.scene, ahead.open->reader, camera);
    });
    return ahead;
}

}  // namespace wrinkle
