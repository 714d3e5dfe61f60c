#include <fmt/format.h>

#include <memory>

#include "base/names.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/options.h"
#include "layers/kinds.h"
#include "tools/accumulate.h"
#include "tools/frame_provenance.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct DecalsArguments {
    std::filesystem::path scene, file = "gradients.exr";
    std::string frames, device;
    std::vector<std::string> set;
    int lanes = 0;
    bool quiet = false;
};

scene::SceneFile load(const DecalsArguments& arguments, std::optional<int> frame) {
    return load_scene_file(arguments.scene, {.set = arguments.set, .frame = frame});
}

void accumulate_decals(const DecalsArguments& arguments) {
    const std::vector<int> frames = arguments.frames.empty() ? std::vector<int>{} : parse_frames(arguments.frames);
    if (lower(arguments.file.extension().string()) != ".exr")
        throw Error(
            fmt::format("-o {}: gradients are written as EXR; name it such as gradients.exr", arguments.file.string()));
    const scene::SceneFile file = load(arguments, frames.empty() ? std::nullopt : std::optional(frames.front()));
    const auto files = frame_files(file);
    check_frame_pattern(files, "--frames", !frames.empty());
    check_frames_exist(files, frames);
    check_output_name("-o", arguments.file.filename().string(), frames);
    AccumulateOptions options;
    options.file = arguments.file;
    options.frames = frames;
    options.device = arguments.device;
    options.lanes = arguments.lanes;
    const bool differ = !file.frame_files.empty();
    if (differ) check_can_be_read_again(arguments.scene);
    if (differ) options.scene_of_frame = [&](int frame) { return load(arguments, frame).scene; };
    options.provenance = [&](int frame) {
        RenderOptions run;
        run.lanes = arguments.lanes;
        // What a run writes of the same scene is another thing.
        return frame_provenance(differ ? load(arguments, frame) : file, run, frame) + " decals";
    };
    const AccumulateReport report = accumulate(file.scene, options);
    if (arguments.quiet) return;
    for (const std::string& warning : report.warnings) fmt::print(stderr, "wrinkle: warning: {}\n", warning);
    for (const std::filesystem::path& written : report.files)
        fmt::print("wrote {}: volume gradients of {} layer{}, {}\n", written.string(), report.layers,
                   report.layers == 1 ? "" : "s",
                   report.normals ? "on the frame's normals"
                                  : "without normals: no angle_fade, footprints as if they faced the viewer");
}

}  // namespace

void add_decals(CLI::App& app) {
    auto arguments = std::make_shared<DecalsArguments>();
    CLI::App* command = app.add_subcommand(
        "decals",
        "Sum up the volume gradients of a scene's decals, for layers of kind gradient to read. Needs positions, or "
        "depth and a camera; normals only for angle_fade and exact footprints");
    command->add_option("SCENE", arguments->scene, "scene file (TOML); of its layers, those of kind decal and decals")
        ->required();
    command
        ->add_option("-o,--output", arguments->file,
                     "an EXR with volume_gradient.X, .Y and .Z (world); of --frames, such as gradients.####.exr")
        ->type_name("FILE")
        ->capture_default_str();
    command->add_option("--frames", arguments->frames, "frame numbers: 7, 1-10, 1-100x5, or several with commas")
        ->type_name("LIST");
    add_set_option(*command, arguments->set);
    add_device_option(*command, arguments->device);
    add_lanes_option(*command, arguments->lanes);
    command->add_flag("--quiet", arguments->quiet, "print errors only");
    command->callback([arguments] { accumulate_decals(*arguments); });
}

}  // namespace wrinkle::cli
