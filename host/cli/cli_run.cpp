#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "io/threads.h"
#include "layers/kinds.h"
#include "tools/render.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct RunArguments {
    std::filesystem::path scene;
    std::string directory = "out", frames, device;
    std::vector<std::string> set;
    int threads = 0, repeat = 1, lanes = 0;
    bool quiet = false, json = false;
    std::optional<double> max_error;
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

void print_budget(const BudgetReport& budget) {
    for (const std::string& miss : budget.misses) fmt::print("missed by {}\n", miss);
    fmt::print("max_error {} degrees: {}\n", budget.max_error, budget.precision);
    fmt::print("  expected {:.2f} ns/pixel, {:.1e} degrees, by the table of {}\n", budget.expected_ns,
               budget.expected_error, budget.costs);
    fmt::print("  measured {:.1e} degrees (median), {:.1e} (99%), {:.1e} (largest) on {} pixels, seed {}\n\n",
               budget.measured.median, budget.measured.p99, budget.measured.max, budget.measured.samples, budget.seed);
}

nlohmann::json json_of(const BudgetReport& budget) {
    return {{"max_error", budget.max_error},
            {"precision", budget.precision},
            {"costs", budget.costs},
            {"expected", {{"ns_per_pixel", budget.expected_ns}, {"degrees", budget.expected_error}}},
            {"measured",
             {{"median", budget.measured.median},
              {"p99", budget.measured.p99},
              {"max", budget.measured.max},
              {"pixels", budget.measured.samples}}},
            {"seed", budget.seed},
            {"misses", budget.misses}};
}

void print_table(const RenderReport& report) {
    const double megapixels = static_cast<double>(report.pixels) / 1e6;
    fmt::print("{} frame{}, {:.2f} Mpixel, {} active layer{} on {} ({} lanes)\n", report.frames,
               report.frames == 1 ? "" : "s", megapixels, report.layers, report.layers == 1 ? "" : "s",
               report.device.name, report.device.lanes);
    for (const std::string& camera : report.cameras) fmt::print("camera: {}\n", camera);
    fmt::print("\n  {:<22}{:>10}\n", "phase", "seconds");
    fmt::print("  {:<22}{:>10.3f}\n", "read", report.read);
    fmt::print("  {:<22}{:>10.3f}\n", "upload (textures)", report.upload);
    fmt::print("  {:<22}{:>10.3f}\n", report.cache_hit ? "build (cache hit)" : "build (compiled)", report.build);
    fmt::print("  {:<22}{:>10.3f}   {:.2f} ns/pixel\n", "kernels", report.kernels, report.kernel_ns_per_pixel);
    if (report.budget) fmt::print("  {:<22}{:>10.3f}\n", "check in double", report.check);
    fmt::print("  {:<22}{:>10.3f}\n", "write", report.write);
    fmt::print("  {:<22}{:>10.3f}   {:.3f} of it outside read, kernels, write\n", "wall (phases overlap)", report.wall,
               report.outside);
    fmt::print("  {:<22}{:>10.0f}\n\n", "peak memory, MiB", static_cast<double>(report.peak_memory) / (1 << 20));
    if (report.budget) print_budget(*report.budget);
    for (const auto& file : report.files) fmt::print("wrote {}\n", file.string());
}

void print_json(const RenderReport& report) {
    nlohmann::json files = nlohmann::json::array();
    for (const auto& file : report.files) files.push_back(file.string());
    fmt::print("{}\n", json_text(nlohmann::json{{"frames", report.frames},
                                                {"pixels", report.pixels},
                                                {"layers", report.layers},
                                                {"device", report.device.name},
                                                {"lanes", report.device.lanes},
                                                {"cache_hit", report.cache_hit},
                                                {"seconds",
                                                 {{"read", report.read},
                                                  {"upload", report.upload},
                                                  {"build", report.build},
                                                  {"kernels", report.kernels},
                                                  {"check", report.check},
                                                  {"write", report.write},
                                                  {"wall", report.wall},
                                                  {"outside", report.outside}}},
                                                {"kernel_ns_per_pixel", report.kernel_ns_per_pixel},
                                                {"peak_memory_bytes", report.peak_memory},
                                                {"cameras", report.cameras},
                                                {"budget", report.budget ? json_of(*report.budget) : nlohmann::json()},
                                                {"warnings", report.warnings},
                                                {"files", files}}));
}

void run(const RunArguments& arguments) {
    RenderOptions options;
    if (!arguments.frames.empty()) options.frames = parse_frames(arguments.frames);
    const auto load = [&arguments](std::optional<int> frame) {
        scene::SceneFile file = load_scene_file(arguments.scene, {.set = arguments.set, .frame = frame});
        if (arguments.max_error) file.scene.budget.max_error = arguments.max_error;
        if (arguments.sample) file.scene.budget.sample = *arguments.sample;
        if (arguments.seed) file.scene.budget.seed = *arguments.seed;
        return file;
    };
    const scene::SceneFile file =
        load(options.frames.empty() ? std::nullopt : std::optional<int>(options.frames.front()));
    const Scene& scene = file.scene;
    if ((arguments.sample || arguments.seed) && !scene.budget.max_error)
        throw Error("--sample and --seed measure an error budget; give --max-error, or max_error in the scene");
    if (arguments.precision && scene.budget.max_error)
        throw Error("--precision and max_error exclude each other: an error budget chooses the precision");
    options.precision = arguments.precision.value_or(Precision::standard);
    options.directory = arguments.directory;
    options.device = arguments.device;
    options.lanes = arguments.lanes;
    options.repeat = arguments.repeat;
    const auto files = frame_files(file);
    check_frame_pattern(files, "--frames", !options.frames.empty());
    check_frames_exist(files, options.frames);
    check_output_name(scene.output.name, options.frames);
    if (!file.frame_files.empty()) {
        if (arguments.scene == "-")
            throw Error("a scene whose textures or tables differ from frame to frame is read again for each; give a "
                        "file in place of standard input");
        options.scene_of_frame = [&load](int frame) { return load(frame).scene; };
    }
    if (arguments.threads > 0) {
        // PoCL reads it when it starts.
        setenv("POCL_MAX_PTHREAD_COUNT", fmt::format("{}", arguments.threads).c_str(), 1);
        set_image_threads(arguments.threads);
    }
    options.progress = progress_bar(!arguments.quiet && !arguments.json);
    const RenderReport report = render(scene, options);
    if (arguments.json) {
        print_json(report);
    } else if (!arguments.quiet) {
        for (const std::string& warning : report.warnings) fmt::print(stderr, "wrinkle: warning: {}\n", warning);
        print_table(report);
    }
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
    command->add_option("--precision", arguments->precision, "of everything: standard (what is usual), exact or double")
        ->type_name("NAME")
        ->transform(CLI::CheckedTransformer(std::map<std::string, Precision>{
            {"standard", Precision::standard}, {"exact", Precision::exact}, {"double", Precision::fp64}}));
    command->add_option("--sample", arguments->sample, "pixels that are measured, with --max-error (4096)")
        ->type_name("N")
        ->check(CLI::Range(1, std::numeric_limits<int>::max()));
    command->add_option("--seed", arguments->seed, "which pixels (1)")
        ->type_name("N")
        ->check(CLI::Range(0, std::numeric_limits<int>::max()));
    command->add_flag("--quiet", arguments->quiet, "print errors only");
    command->add_flag("--json", arguments->json, "print the report as JSON");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace wrinkle::cli
