#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/atomic_file.h"
#include "cli/checks.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/options.h"
#include "tools/farm_job.h"
#include "tools/frame_lights.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

namespace fs = std::filesystem;

struct JobArguments {
    fs::path scene, directory = "out";
    std::string frames, engine, program = "wrinkle";
    std::vector<std::string> set, run_options;
    int chunk = 20;
};

struct Engine {
    std::string name, file, start;
    std::string (*text)(const FarmJob&);
};

const std::vector<Engine>& engines() {
    static const std::vector<Engine> all{
        {"openjd", "wrinkle.openjd.json", "openjd run --extensions TASK_CHUNKING {}", openjd_template},
        {"slurm", "wrinkle.sbatch", "sbatch {}", slurm_script},
        {"opencue", "wrinkle.outline.py", "python3 {}", opencue_outline}};
    return all;
}

std::string absolute_name(const fs::path& path) { return fs::absolute(path).lexically_normal().string(); }

FarmJob job_of(const JobArguments& arguments) {
    FarmJob job{
        .name = arguments.scene.stem().string(),
        .command = {arguments.program, "run", absolute_name(arguments.scene), "-o", absolute_name(arguments.directory)},
        .frames = parse_frames(arguments.frames),
        .chunk = arguments.chunk};
    for (const std::string& setting : arguments.set) job.command.insert(job.command.end(), {"--set", setting});
    job.command.insert(job.command.end(), arguments.run_options.begin(), arguments.run_options.end());
    job.command.insert(job.command.end(), {"--resume", "--keep-going", "--frames"});
    return job;
}

void write_job(const JobArguments& arguments) {
    if (arguments.scene == "-")
        throw Error("a farm's tasks read the scene themselves; give a file, not standard input");
    const FarmJob job = job_of(arguments);
    const scene::SceneFile file = load_scene_file(arguments.scene, {.set = arguments.set, .frame = job.frames.front()});
    check_frame_pattern(frame_files(file), "--frames", true);
    check_output_name("[output] name =", file.scene.output.name, job.frames);
    const Engine& engine = *std::ranges::find(engines(), arguments.engine, &Engine::name);
    if (wants_lights(file.scene) && file.scene.lighting.lights.empty())
        fmt::print(
            stderr,
            "wrinkle: warning: this scene names no light, so that each task fits its own to its first frame, and "
            "tasks will differ; write them into the scene first, by \"wrinkle fit-lights\"\n");
    else if (wants_lights(file.scene))
        fmt::print(
            stderr,
            "wrinkle: warning: each task tells from the picture of its first frame how strong the lights are, and "
            "tasks may differ; give the lights in the picture's units, and shadows = \"read\" in [lighting]\n");
    if (file.scene.budget.max_area_error)
        fmt::print(stderr,
                   "wrinkle: warning: max_area_error is measured by each task on its first frame, and tasks may differ "
                   "in taps; set [filter] taps in its place, by what \"wrinkle run\" of one frame reports\n");
    std::error_code failed;  // the file tells it better
    fs::create_directories(arguments.directory, failed);
    const fs::path path = arguments.directory / engine.file;
    AtomicFile out(path);
    out.write(engine.text(job));
    out.commit();
    fmt::print("wrote {}; start it with: {}\n", path.string(), fmt::format(fmt::runtime(engine.start), path.string()));
}

}  // namespace

void add_job(CLI::App& app) {
    auto arguments = std::make_shared<JobArguments>();
    CLI::App* command = app.add_subcommand(
        "job", "Describe a sequence for a farm: tasks of some frames each, which call \"wrinkle run --resume\"");
    command->add_option("SCENE", arguments->scene, "scene file (TOML), where every node sees it")->required();
    command->add_option("RUN_OPTIONS", arguments->run_options,
                        "behind --: options of run for every task, as in -- --max-error 0.01");
    command->add_option("--frames", arguments->frames, "frame numbers, as of run")->type_name("LIST")->required();
    command->add_option("--chunk", arguments->chunk, "frames a task, at most")
        ->capture_default_str()
        ->check(CLI::Range(1, 1'000'000));
    std::vector<std::string> names;
    for (const Engine& engine : engines()) names.push_back(engine.name);
    command
        ->add_option("--for", arguments->engine,
                     "openjd: a template of the Open Job Description; slurm: a script for sbatch; opencue: an outline")
        ->type_name("ENGINE")
        ->required()
        ->check(one_of(names));
    command->add_option("--program", arguments->program, "what nodes call wrinkle")
        ->type_name("PATH")
        ->capture_default_str();
    command->add_option("-o,--output", arguments->directory, "folder for the pictures, and for the description")
        ->type_name("DIR")
        ->capture_default_str();
    add_set_option(*command, arguments->set);
    command->callback([arguments] { write_job(*arguments); });
}

}  // namespace wrinkle::cli
