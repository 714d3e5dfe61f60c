#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "contenders.h"
#include "run/render.h"
#include "wrinkle/error.h"

namespace {

using namespace wrinkle;

/// Time of a warm run outside reading, kernels and writing, the median of several.
double warm_run_outside(const Scene& scene, const std::filesystem::path& directory) {
    std::vector<double> outside;
    for (int i = 0; i < 4; ++i) {
        RenderOptions options;
        options.directory = directory;
        const double seconds = render(scene, options).outside;
        if (i > 0) outside.push_back(seconds);
    }
    return bench::timing(outside).median;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Measures wrinkle's speed beside its error, against plain C++ in the same run."};
    std::filesystem::path scene_file = WRINKLE_SOURCE_DIR "/data/scenes/courtyard.toml", json;
    Size size{3840, 2160};
    int repetitions = 9;
    std::string device_name;
    app.add_option("--scene", scene_file, "scene to measure")->capture_default_str();
    app.add_option("--width", size.width, "pixels")->capture_default_str()->check(CLI::Range(16, 65536));
    app.add_option("--height", size.height, "pixels")->capture_default_str()->check(CLI::Range(16, 65536));
    app.add_option("--repetitions", repetitions, "times that each contender runs; medians are reported")
        ->capture_default_str()
        ->check(CLI::Range(3, 1000));
    app.add_option("--device", device_name, "OpenCL device; see \"wrinkle devices\"");
    app.add_option("--json", json, "also write the report as JSON");
    CLI11_PARSE(app, argc, argv);
    try {
        const Device device = Device::open(device_name);
        const Scene file_scene = load_scene(scene_file);
        bench::Report report;
        report.device = fmt::format("{} ({} lanes)", device.info.name, device.info.lanes);
        report.processor = bench::processor_name();
        report.size = size;
        report.repetitions = repetitions;
        {
            const bench::BenchFrame frame = bench::resampled_frame(file_scene, size);
            bench::measure_demo(device, bench::without_lighting(file_scene, frame.frame), frame, report);
        }
        bench::measure_memory(device, report);
        const auto directory = std::filesystem::temp_directory_path() / "wrinkle_bench";
        report.run_outside = warm_run_outside(file_scene, directory);
        std::filesystem::remove_all(directory);
        bench::print(report);
        if (!json.empty()) {
            std::ofstream out(json);
            out << bench::to_json(report).dump(2) << '\n';
            if (!out.flush()) throw Error(fmt::format("cannot write {}", json.string()));
        }
    } catch (const Error& error) {
        fmt::print(stderr, "wrinkle_bench: {}\n", error.what());
        return 1;
    }
    return 0;
}
