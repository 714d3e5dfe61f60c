#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>

#include "base/atomic_file.h"
#include "base/same_file.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "io/frame_path.h"
#include "layers/kinds.h"
#include "scene/check_scene.h"
#include "tools/frame_lights.h"

namespace wrinkle::cli {

namespace {

struct FitArguments {
    std::filesystem::path scene, file;
    std::optional<int> frame;
};

void fit(const FitArguments& arguments) {
    const Scene scene = load_scene(arguments.scene);
    const int number = arguments.frame.value_or(0);
    if (!arguments.file.empty()) {
        refuse_to_replace(arguments.file, scene::files_of(layer_kinds(), scene));
        refuse_to_replace(arguments.file,
                          std::array{frame_path(scene.gbuffer.file, number), frame_path(scene.camera.file, number)});
    }
    check_frame_pattern(frame_files(scene.gbuffer, scene.camera), "--frame", arguments.frame.has_value());
    const FrameLights lights = lights_of_frame(scene, number);
    const std::string text = lights_as_toml(lights);
    if (arguments.file.empty()) {
        fmt::print("{}", text);
        return;
    }
    AtomicFile file(arguments.file);
    file.write(text);
    file.commit();
    fmt::print("wrote {}: {}\n", arguments.file.string(), summary(lights));
}

}  // namespace

void add_fit_lights(CLI::App& app) {
    auto arguments = std::make_shared<FitArguments>();
    CLI::App* command = app.add_subcommand(
        "fit-lights",
        "Estimate the lights of a scene's frame from its picture, normals and albedo, as [[light]] tables");
    command->add_option("SCENE", arguments->scene, "scene file (TOML); its layers and lights do not matter")
        ->required();
    command->add_option("-o,--output", arguments->file, "write them to a file instead of printing them")
        ->type_name("FILE");
    command->add_option("--frame", arguments->frame, "frame number, for scenes of a sequence");
    command->callback([arguments] { fit(*arguments); });
}

}  // namespace wrinkle::cli
