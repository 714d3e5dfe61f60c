#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "base/atomic_file.h"
#include "base/same_file.h"
#include "base/text_file.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/options.h"
#include "cli/run_report.h"
#include "io/frame_path.h"
#include "io/threads.h"
#include "layers/kinds.h"
#include "look/report.h"
#include "tools/frame_lights.h"
#include "tools/frame_provenance.h"
#include "tools/render.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct RunArguments {
    std::filesystem::path scene;
    std::string directory = "out", frames, device, report;
    std::vector<std::string> set;
    int threads = 0, repeat = 1, lanes = 0;
    bool quiet = false, json = false, resume = false, force = false, keep_going = false, strict = false;
    std::optional<double> max_error, max_area_error;
    std::optional<int> sample, seed;
    std::optional<Precision> precision;
};

/// Draws a progress bar, if one is wanted and stderr is a terminal.
std::function<void(double)> progress_bar(bool wanted) {
    if (!wanted || isatty(STDERR_FILENO) == 0) return {};
    return [](double share) {
        constexpr int width = 40;
        const int full = static_cast<int>(share * width);
        fmt::print(stderr, "\r[{:=<{}}{:<{}}] {:3.0f}%", "", full, "", width - full, share * 100);
        if (share >= 1) fmt::print(stderr, "\r{:<{}}\r", "", width + 8);
        std::fflush(stderr);
    };
}

/// The scene of a run, read again for frames whose textures or tables differ.
class RunScene {
public:
    explicit RunScene(const RunArguments& arguments) : arguments_(arguments) {}

    /// With the numbers of `frame` in its names. The reference holds until another frame is asked for.
    const scene::SceneFile& at(std::optional<int> frame) {
        if (file_ && (frame == frame_ || file_->frame_files.empty())) return *file_;
        scene::SceneFile file = load_scene_file(arguments_.scene, {.set = arguments_.set, .frame = frame});
        if (arguments_.max_error) file.scene.budget.max_error = arguments_.max_error;
        if (arguments_.max_area_error) file.scene.budget.max_area_error = arguments_.max_area_error;
        if (arguments_.sample) file.scene.budget.sample = *arguments_.sample;
        if (arguments_.seed) file.scene.budget.seed = *arguments_.seed;
        file_ = std::move(file), frame_ = frame;
        return *file_;
    }

    /// That of the first of the frames; with --keep-going, of the first for which there is one.
    const scene::SceneFile& first(const std::vector<int>& frames) {
        for (const int frame : frames) {
            try {
                return at(frame);
            } catch (const Error&) {
                if (!arguments_.keep_going || frame == frames.back()) throw;
            }
        }
        return at(std::nullopt);
    }

private:
    const RunArguments& arguments_;
    std::optional<scene::SceneFile> file_;
    std::optional<int> frame_;
};

RenderOptions options_of(const RunArguments& arguments, const Scene& scene) {
    if ((arguments.sample || arguments.seed) && !scene.budget.max_error && !scene.budget.max_area_error)
        throw Error(
            "--sample and --seed measure an error budget; give --max-error or --max-area-error, or max_error or "
            "max_area_error in the scene");
    if (arguments.precision && scene.budget.max_error)
        throw Error("--precision and max_error exclude each other: an error budget chooses the precision");
    RenderOptions options;
    options.precision = arguments.precision.value_or(Precision::standard);
    options.directory = arguments.directory;
    options.device = arguments.device;
    options.lanes = arguments.lanes;
    options.repeat = arguments.repeat;
    options.resume = arguments.resume && !arguments.force;
    options.keep_going = arguments.keep_going;
    options.strict = arguments.strict;
    return options;
}

/// What of a sequence went wrong while the rest was written.
void tell_failures(const RenderReport& report, bool strict) {
    std::string text;
    for (const FrameReport& frame : report.failed) text += fmt::format("\nframe {}: {}", frame.frame, frame.error);
    if (!text.empty())
        throw Error(fmt::format("{} of {} frames failed:{}", report.failed.size(),
                                report.failed.size() + static_cast<std::size_t>(report.frames + report.skipped), text));
    if (strict && !report.warnings.empty()) throw Error(report.warnings.front() + " (--strict)");
}

/// Makes the folder of a file as --output makes its own; where that fails, opening the file tells it better.
const std::filesystem::path& with_its_folder(const std::filesystem::path& file) {
    std::error_code failed;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failed);
    return file;
}

/// The page of --report. Its file is opened before anything runs, so that what is wrong with its name is told at once.
class ReportFile {
public:
    ReportFile(const std::filesystem::path& path, const scene::SceneFile& scene, const std::vector<int>& frames)
        : path_(path), file_(with_its_folder(path)) {
        std::vector<std::filesystem::path> inputs = scene.files;
        inputs.push_back(scene.scene.file);
        for (const int frame : frames.empty() ? std::vector{0} : frames)
            for (const std::filesystem::path& file : scene.kept_files) inputs.push_back(frame_path(file, frame));
        refuse_to_replace(path, inputs);
    }

    /// Shows the first frame that did not fail; of none there is no page.
    void write(const RunArguments& arguments, RunScene& scenes, const RenderReport& report,
               const RenderOptions& options) {
        const std::vector<int> numbers = options.frames.empty() ? std::vector{0} : options.frames;
        const auto shown = std::ranges::find_if(numbers, [&](int number) {
            return std::ranges::find(report.failed, number, &FrameReport::frame) == report.failed.end();
        });
        if (shown == numbers.end()) return;
        const scene::SceneFile& file = scenes.at(options.frames.empty() ? std::nullopt : std::optional(*shown));
        Scene scene = file.scene;
        if (report.taps) scene.filter.taps = report.taps->taps;
        write_report(file_, {.scene = std::move(scene),
                             .run = report,
                             .frame = *shown,
                             .source = arguments.scene == "-" ? file.text : read_text(arguments.scene),
                             .set = arguments.set,
                             .provenance = options.provenance(*shown),
                             .device = arguments.device});
        if (!arguments.quiet && !arguments.json) fmt::print("wrote {}\n", path_.string());
    }

private:
    std::filesystem::path path_;
    AtomicFile file_;
};

void run(const RunArguments& arguments) {
    const std::vector<int> frames = arguments.frames.empty() ? std::vector<int>{} : parse_frames(arguments.frames);
    RunScene scenes(arguments);
    const scene::SceneFile file = scenes.first(frames);
    const Scene& scene = file.scene;
    RenderOptions options = options_of(arguments, scene);
    options.frames = frames;
    const auto files = frame_files(file);
    check_frame_pattern(files, "--frames", !frames.empty());
    if (!arguments.keep_going) check_frames_exist(files, frames);
    check_output_name("[output] name =", scene.output.name, frames);
    if (!file.frame_files.empty()) {
        check_can_be_read_again(arguments.scene);
        options.scene_of_frame = [&](int frame) { return scenes.at(frame).scene; };
    }
    // Lights that are fitted are those of the first frame; so are the taps of a budget.
    const bool measured = wants_lights(scene) || scene.budget.max_area_error;
    const std::string first = measured && !frames.empty() ? fmt::format(" {}", frames.front()) : "";
    options.provenance = [&, first](int frame) {
        return frame_provenance(file.frame_files.empty() ? file : scenes.at(frame), options, frame) + first;
    };
    if (arguments.threads > 0) {
        // PoCL reads it when it starts.
        setenv("POCL_MAX_PTHREAD_COUNT", fmt::format("{}", arguments.threads).c_str(), 1);
        set_image_threads(arguments.threads);
    }
    std::optional<ReportFile> page;
    if (!arguments.report.empty()) page.emplace(arguments.report, file, frames);
    options.progress = progress_bar(!arguments.quiet && !arguments.json);
    if (!frames.empty() && (arguments.json || (!arguments.quiet && !options.progress)))
        options.frame_done = FrameLines(frames.size(), arguments.json);
    const RenderReport report = render(scene, options);
    if (arguments.json) {
        print_json(report, !frames.empty());
    } else if (!arguments.quiet) {
        for (const std::string& warning : report.warnings) fmt::print(stderr, "wrinkle: warning: {}\n", warning);
        print_table(report);
    }
    try {
        if (page) page->write(arguments, scenes, report, options);
    } catch (const Error&) {
        tell_failures(report, arguments.strict);  // they matter more
        throw;
    }
    tell_failures(report, arguments.strict);
}

}  // namespace

void add_run(CLI::App& app) {
    auto arguments = std::make_shared<RunArguments>();
    CLI::App* command = app.add_subcommand("run", "Evaluate a scene and write its pictures");
    command->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
    command->add_option("-o,--output", arguments->directory, "folder for the pictures, made if missing")
        ->type_name("DIR")
        ->capture_default_str();
    command->add_option("--frames", arguments->frames, "frame numbers: 7, 1-10, 1-100x5, or several with commas")
        ->type_name("LIST");
    add_set_option(*command, arguments->set);
    add_device_option(*command, arguments->device);
    add_lanes_option(*command, arguments->lanes);
    command->add_option("--threads", arguments->threads, "threads for files and for CPU kernels; 0: all cores")
        ->check(CLI::Range(0, 1024));
    command->add_option("--repeat", arguments->repeat, "run the kernels N times and report the median, to time them")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    add_max_error_option(*command, arguments->max_error, "computes no more exactly than that takes, and measures it");
    add_max_area_error_option(*command, arguments->max_area_error);
    command->add_option("--precision", arguments->precision, "of everything: standard (what is usual), exact or double")
        ->type_name("NAME")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Precision>{
            {"standard", Precision::standard}, {"exact", Precision::exact}, {"double", Precision::fp64}}));
    command
        ->add_option("--sample", arguments->sample,
                     "pixels that are measured, with --max-error (4096); of areas 400 at most")
        ->type_name("N")
        ->check(CLI::Range(1, std::numeric_limits<int>::max()));
    command->add_option("--seed", arguments->seed, "which pixels (1)")
        ->type_name("N")
        ->check(CLI::Range(0, std::numeric_limits<int>::max()));
    command
        ->add_option("--report", arguments->report,
                     "also write one HTML page to send to somebody: pictures before and after, each layer alone, "
                     "times, errors; of --frames, the first")
        ->type_name("PAGE.html");
    command->add_flag("--resume", arguments->resume,
                      "skip frames whose files are there, of the same scene, files, options and version");
    command->add_flag("--force", arguments->force, "evaluate them all the same, whatever --resume would skip");
    command->add_flag("--keep-going", arguments->keep_going,
                      "after a frame that fails; which ones did is told at the end, with exit code 1");
    command->add_flag("--strict", arguments->strict, "a frame that would be warned of fails");
    command->add_flag("--quiet", arguments->quiet, "print errors only");
    command->add_flag("--json", arguments->json,
                      "print the report as JSON; of --frames, a line for each and the report in the last");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace wrinkle::cli
