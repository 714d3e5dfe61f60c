#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "budget/tune.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "tools/area_costs.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct TuneArguments {
    std::vector<std::filesystem::path> scenes;
    std::string device;
    std::filesystem::path file;
    TuneOptions options;
    bool quiet = false;
};

/// Pixels whose areas are integrated are fewer: each takes 1024 points.
AreaOptions area_options(const TuneArguments& arguments) {
    constexpr int most_pixels = 400;
    return {.sample = std::min(arguments.options.sample, most_pixels),
            .seed = arguments.options.seed,
            .bumped = true,
            .repeat = arguments.options.repeat,
            .device = arguments.device};
}

/// Prints the old and the new costs of every kind and variant side by side.
void print_changes(const DeviceCosts& before, const DeviceCosts& after) {
    fmt::print("{} ({}), against {}\n\n", after.device, after.device_class, before.device);
    fmt::print("  {:<22}{:<10}{:>22}{:>28}{:>28}\n", "kind", "variant", "ns/pixel", "99% of errors, degrees",
               "largest, degrees");
    const auto row = [](const std::optional<VariantCost>& old, double VariantCost::*member, double now,
                        const char* digits) {
        const std::string was = old ? fmt::format(fmt::runtime(digits), (*old).*member) : "-";
        return was + " -> " + fmt::format(fmt::runtime(digits), now);
    };
    for (const auto& [kind, variants] : after.kinds)
        for (const auto& [precision, cost] : variants) {
            const auto old = before.find(kind, precision);
            fmt::print("  {:<22}{:<10}{:>22}{:>28}{:>28}\n", kind, precision_name(precision),
                       row(old, &VariantCost::ns, cost.ns, "{:.2f}"), row(old, &VariantCost::p99, cost.p99, "{:.1e}"),
                       row(old, &VariantCost::max, cost.max, "{:.1e}"));
        }
}

/// Prints what taps cost every kind that was measured, and what they leave.
void print_areas(const DeviceCosts& costs) {
    if (costs.areas.empty()) return;
    fmt::print("\nover the areas that pixels show\n\n  {:<22}{:>6}{:>12}{:>24}{:>10}\n", "kind", "taps", "ns/pixel",
               "degrees off: median", "99%");
    for (const auto& [kind, rows] : costs.areas)
        for (const auto& [taps, cost] : rows)
            fmt::print("  {:<22}{:>6}{:>12.2f}{:>24.3g}{:>10.3g}\n", kind, taps, cost.ns, cost.median, cost.p99);
}

void tune(TuneArguments& arguments) {
    const std::filesystem::path file = arguments.file.empty() ? user_costs_file() : arguments.file;
    if (file.empty()) throw Error("there is no cache folder (WRINKLE_CACHE_DIR, XDG_CACHE_HOME, HOME); give --output");
    std::vector<Scene> scenes;
    for (const auto& scene : arguments.scenes) scenes.push_back(load_scene(scene));
    const Device device = Device::open(arguments.device);
    const DeviceCosts before = costs_of(device.info);
    arguments.options.progress = [&](const std::string& what) {
        if (!arguments.quiet) fmt::print(stderr, "{}\n", what);
    };
    std::error_code failed;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failed);
    DeviceCosts after = measure_costs(device, scenes, arguments.options);
    merge_costs(file, after);  // so that it is kept if the rest is interrupted
    after.areas = measure_area_costs(scenes, area_options(arguments), arguments.options.progress);
    merge_costs(file, after);
    if (!arguments.quiet) {
        print_changes(before, after);
        print_areas(after);
        fmt::print("\nwrote {}\n", file.string());
    }
}

}  // namespace

void add_tune(CLI::App& app) {
    auto arguments = std::make_shared<TuneArguments>();
    CLI::App* command = app.add_subcommand("tune",
                                           "Measure what every variant of the scenes' layers costs and errs by on this "
                                           "device, and every number of taps: the "
                                           "table that a scene's max_error is kept by, and that explain quotes");
    command->add_option("SCENE", arguments->scenes, "scene files (TOML), such as data/scenes/*.toml")->required();
    add_device_option(*command, arguments->device);
    command->add_option("-o,--output", arguments->file, "the table; else precision.json in the cache folder")
        ->type_name("FILE");
    command->add_option("--repeat", arguments->options.repeat, "runs of each kernel; their median counts")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_option("--sample", arguments->options.sample, "pixels whose errors are measured")
        ->capture_default_str()
        ->check(CLI::Range(1, 1 << 30));
    command->add_option("--seed", arguments->options.seed, "which pixels")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    command->add_flag("--quiet", arguments->quiet, "print errors only");
    command->callback([arguments] { tune(*arguments); });
}

}  // namespace wrinkle::cli
