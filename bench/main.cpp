#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>

#include "bars.h"
#include "compare.h"
#include "contests.h"
#include "decals.h"
#include "functions.h"
#include "lights.h"
#include "memory.h"
#include "report.h"
#include "scenes.h"
#include "sizes.h"
#include "tools/render.h"
#include "volume.h"
#include "wrinkle/error.h"

namespace {

using namespace wrinkle;
namespace fs = std::filesystem;

const std::vector<std::string> all_parts{"memory",  "functions", "demo", "scenes", "decals", "volume", "variants",
                                         "storage", "ablation",  "bars", "sizes",  "area",   "lights", "lighting"};
/// Without lighting: a minute for a figure that changes with the demo's lights only.
const std::vector<std::string> usual_parts = [] {
    std::vector<std::string> parts = all_parts;
    std::erase(parts, "lighting");
    return parts;
}();
const std::vector<std::string> quick_parts{"memory", "functions", "demo", "scenes", "storage"};

struct Arguments {
    std::vector<std::string> only;
    std::string function, device;
    std::vector<int> lanes;
    fs::path scene, json, report, compare;
    Size size{3840, 2160};
    int repetitions = 9;
    double seconds = 10;
    bool quick = false;
};

CLI::App& describe(CLI::App& app, Arguments& a) {
    app.add_option("--only", a.only, fmt::format("parts to measure, of {}", fmt::join(all_parts, ", ")))
        ->delimiter(',')
        ->check(CLI::IsMember(all_parts));
    app.add_option("--function", a.function,
                   "of the functions, only this one; on 1, 4, 8 and 16 lanes, unless --lanes says otherwise");
    app.add_option("--lanes", a.lanes,
                   "of the functions in float, on so many lanes: 1, 4, 8, 16, or several; else the device's")
        ->delimiter(',')
        ->check(CLI::IsMember({1, 4, 8, 16}));
    app.add_option("--scene", a.scene, "scene of the part demo; else data/scenes/courtyard.toml");
    app.add_option("--width", a.size.width, "pixels of frames; sizes have their own")
        ->capture_default_str()
        ->check(CLI::Range(16, 65536));
    app.add_option("--height", a.size.height, "pixels")->capture_default_str()->check(CLI::Range(16, 65536));
    app.add_option("--repetitions", a.repetitions,
                   "times that each contender runs at least, or 6 where runs take seconds; medians are reported")
        ->capture_default_str()
        ->check(CLI::Range(3, 1000));
    app.add_option(
           "--seconds", a.seconds,
           "seconds that a race of contenders goes on at least, since what disturbs it lasts for some; functions "
           "and layers make do with the repetitions")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 3600.0));
    app.add_flag("--quick", a.quick,
                 "small frames, errors of functions without their speeds, no contests, no more rounds than "
                 "--repetitions: for accuracy, not for speed");
    app.add_option("--device", a.device, "OpenCL device; see \"wrinkle devices\"");
    app.add_option("--json", a.json, "also write the run as JSON");
    app.add_option("--report", a.report, "also write run.json, run.csv, charts and index.html to this folder");
    app.add_option("--compare", a.compare,
                   "flag what became slower or less accurate than in this run, by more than the spreads explain; "
                   "exit code 1 when accuracy did");
    return app;
}

void measure(const Device& device, const Arguments& a, bench::Run& run) {
    const auto wanted = [&](const char* part) {
        const std::vector<std::string>& parts = !a.only.empty() ? a.only : a.quick ? quick_parts : usual_parts;
        return std::ranges::find(parts, part) != parts.end();
    };
    const Size size = a.quick ? Size{960, 540} : a.size;
    bench::measure_memory(device, size, run);  // always, as other parts are shown as shares of its ceilings
    if (wanted("functions")) {
        bench::FunctionBench options{
            .only = a.function, .lanes = a.lanes, .repetitions = run.rounds.least, .speed = !a.quick};
        if (!a.function.empty() && a.lanes.empty()) options.lanes = {1, 4, 8, 16};
        std::ranges::move(bench::measure_functions(device, options), std::back_inserter(run.measurements));
    }
    const fs::path demo = a.scene.empty() ? WRINKLE_SOURCE_DIR "/data/scenes/courtyard.toml" : a.scene;
    if (wanted("demo")) bench::measure_scene(device, demo, size, true, run);
    if (wanted("scenes")) {
        std::set<fs::path> files;
        for (const auto& entry : fs::directory_iterator(WRINKLE_SOURCE_DIR "/bench/scenes")) files.insert(entry.path());
        for (const fs::path& file : files) bench::measure_scene(device, file, size, false, run);
    }
    if (wanted("variants")) bench::measure_variants(device, size, run);
    if (wanted("area")) bench::measure_area(device, run);
    if (wanted("storage")) {
        bench::measure_storage(device, size, run);
        bench::measure_stored_area(device, run);
    }
    if (wanted("ablation")) bench::measure_ablation(device, demo, size, run);
    if (wanted("bars")) {
        bench::measure_stack(device, size, run);
        bench::measure_noise(device, run);
        bench::measure_screen(device, size, run);
        bench::measure_cores(device, size, run);
        bench::measure_files(size, run);
    }
    if (wanted("decals")) bench::measure_decals(device, size, a.quick, run);
    if (wanted("lights")) bench::measure_lights(device, size, a.quick, run);
    if (wanted("lighting")) bench::measure_lighting(device, demo, size, run);
    if (wanted("volume")) bench::measure_volumes(device, a.quick ? 64 : 256, run);
    if (wanted("sizes"))
        bench::measure_sizes(device, demo, {{1280, 800}, {3840, 2160}, {7680, 4320}, {15360, 8640}}, run);
}

/// Lets the waiting threads of OpenMP sleep. By default they spin, which takes time from the kernels that run next.
/// OpenMP reads its settings before main, so the program sets the variable and starts itself anew.
void wait_quietly(char** argv) {
    if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
    ::setenv("OMP_WAIT_POLICY", "passive", 1);
    std::error_code unknown;
    const fs::path self = fs::read_symlink("/proc/self/exe", unknown);  // else ps would show it as "exe"
    ::execv(self.c_str(), argv);
}

}  // namespace

int main(int argc, char** argv) {
    wait_quietly(argv);
    CLI::App app{
        "Measures wrinkle's speed beside its error, against plain C++ and the machine's ceilings in the same run.",
        "wrinkle bench"};
    Arguments arguments;
    describe(app, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        fmt::print(stderr, "wrinkle bench: {}\nRun \"wrinkle bench --help\" for what it can do.\n", error.what());
        return 2;
    }
    try {
        const Device device = Device::open(arguments.device);
        bench::Run run;
        // Files that cannot be read or written are found out now, not after minutes of measuring.
        if (!arguments.compare.empty()) bench::read_run(arguments.compare);
        if (!arguments.report.empty()) bench::make_folder(arguments.report);
        if (arguments.json.has_parent_path()) bench::make_folder(arguments.json.parent_path());
        run.device =
            fmt::format("{}, {} compute units, {}", device.info.name, device.info.compute_units, device.info.driver);
        run.processor = bench::processor_name();
        for (int i = 1; i < argc; ++i) run.command += (i > 1 ? " " : "") + std::string(argv[i]);
        run.rounds = {arguments.repetitions, arguments.quick ? 0 : arguments.seconds};
        measure(device, arguments, run);
        run.bars = bench::bars_of(run);
        bench::print(run);
        if (!arguments.json.empty()) bench::write_json(run, arguments.json);
        if (!arguments.report.empty()) bench::write_report(run, arguments.report);
        if (!arguments.compare.empty() && !bench::compare(bench::read_run(arguments.compare), run)) return 1;
    } catch (const Error& error) {
        fmt::print(stderr, "wrinkle bench: {}\n", error.what());
        return 1;
    }
    return 0;
}
