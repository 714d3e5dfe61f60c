#include "tools/accumulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/same_file.h"
#include "device/guarded.h"
#include "io/frame_path.h"
#include "layers/kinds.h"
#include "plan/section.h"
#include "run/frame_run.h"
#include "run/open_frame.h"
#include "tools/frame_warnings.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// The scene with nothing but its decals. Throws Error where it has none.
Scene decals_of(Scene scene) {
    std::erase_if(scene.layers, [](const Layer& layer) { return !kind_of(layer_kinds(), layer).without_normal; });
    scene.lighting = {};  // which has masks of its own
    if (!scene.layers.empty()) return scene;
    throw Error(fmt::format("{}: no layer is of kind decal or decals, so there is nothing to accumulate",
                            scene.file.empty() ? "the scene" : scene.file.string()));
}

/// Decals are evaluated on the frame's own surface. Those that a run evaluates on another one are told.
std::vector<std::string> doubts_of(const Scene& scene) {
    std::vector<std::string> lines;
    const Layer* changes = nullptr;
    for (const Layer& layer : scene.layers) {
        const LayerKind& kind = kind_of(layer_kinds(), layer);
        if (kind.ends_stage || kind.moves) changes = &layer;
        if (kind.without_normal && changes)
            lines.push_back(fmt::format("{} comes after the {} \"{}\", but is accumulated on the frame's own surface",
                                        layer_label(layer), changes->kind(), changes->name));
    }
    return lines;
}

class Accumulation {
public:
    Accumulation(const Scene& scene, const AccumulateOptions& options) : scene_(scene), options_(options) {}

    AccumulateReport run() {
        add(doubts_of(scene_));
        report_.layers = decals_of(scene_).layers.size();
        Device device = Device::open(options_.device);
        if (options_.lanes != 0) device.info.lanes = options_.lanes;
        TextureStore store(device);
        std::optional<MaskMatches> matches;
        const std::vector<int> frames = options_.frames.empty() ? std::vector<int>{0} : options_.frames;
        for (const int number : frames) {
            if (options_.scene_of_frame) pass_.reset();
            const Scene scene = options_.scene_of_frame ? options_.scene_of_frame(number) : scene_;
            MaskMatches looks_for(decals_of(scene));
            if (!matches || !matches->looks_for_the_same(looks_for)) {
                if (matches) add(matches->warnings());
                matches = std::move(looks_for);
            }
            accumulate_frame(device, scene, store, *matches, number);
            if (options_.scene_of_frame) store.keep_latest();
        }
        if (matches) add(matches->warnings());
        return std::move(report_);
    }

private:
    void add(const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            if (std::ranges::find(report_.warnings, line) == report_.warnings.end()) report_.warnings.push_back(line);
    }

    void accumulate_frame(const Device& device, const Scene& of_frame, TextureStore& store, MaskMatches& matches,
                          int number) {
        const Scene scene = decals_of(of_frame);
        GBufferReader reader = open_frame(scene, number);
        const FrameCamera camera = camera_of_frame(scene, reader, number);
        add(frame_warnings(scene, reader, camera));
        const std::filesystem::path file =
            options_.frames.empty()
                ? options_.file
                : options_.file.parent_path() / with_frame(options_.file.filename().string(), number);
        refuse_to_replace(file, inputs_of(of_frame, reader, number));
        const Frame frame = frame_of(scene, reader, camera);
        report_.normals = frame.planes.contains("normal.x");
        Pass& pass = pass_for(device, scene, frame, store);
        add(store.doubts());
        FrameOutputs outputs = FrameOutputs::single(file, scene, pass.impl(), reader,
                                                    options_.provenance ? options_.provenance(number) : std::string{});
        PhaseClock clock;
        FrameRun run(pass.impl(), reader, clock);
        matches.begin(frame, reader.object_storage());
        run.match_masks(matches);
        run.write_to(outputs);
        run.run();
        pass.impl().save();
        outputs.finish(report_.files);
    }

    Pass& pass_for(const Device& device, const Scene& scene, const Frame& frame, TextureStore& store) {
        if (pass_ && same_shape(frame, pass_frame_)) {
            pass_->set_camera(frame.camera);
            return *pass_;
        }
        Scene alone = scene;
        alone.output = {};
        pass_.emplace(accumulate_decals(device, alone, frame, {}, &store));
        pass_frame_ = frame;
        return *pass_;
    }

    const Scene& scene_;
    const AccumulateOptions& options_;
    AccumulateReport report_;
    std::optional<Pass> pass_;
    Frame pass_frame_;
};

}  // namespace

AccumulateReport accumulate(const Scene& scene, const AccumulateOptions& options) {
    return guarded("accumulate decals", [&] { return Accumulation(scene, options).run(); });
}

}  // namespace wrinkle
