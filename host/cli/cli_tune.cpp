#include <fmt/format.h>

#include <memory>
#include <vector>

#include "budget/tune.h"
#include "cli/commands.h"
#include "cli/options.h"
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

void tune(TuneArguments& arguments) {
    const std::filesystem::path file = arguments.file.empty() ? user_costs_file() : arguments.file;
    if (file.empty()) throw Error("there is no cache folder (WRINKLE_CACHE_DIR, XDG_CACHE_HOME, HOME); give --output");
    std::vector<Scene> scenes;
    for (const auto& scene : arguments.scenes) scenes.push_back(load_scene(scene));
    const Device device = Device::open(arguments.device);
    const DeviceCosts before = costs_of(device.info);
    if (!arguments.quiet)
        arguments.options.progress = [](const std::string& what) { fmt::print(stderr, "{}\n", what); };
    const DeviceCosts after = measure_costs(device, scenes, arguments.options);
    std::error_code failed;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failed);
    merge_costs(file, after);
    if (!arguments.quiet) {
        print_changes(before, after);
        fmt::print("\nwrote {}\n", file.string());
    }
}

}  // namespace

void add_tune(CLI::App& app) {
    auto arguments = std::make_shared<TuneArguments>();
    CLI::App* command = app.add_subcommand(
        "tune",
        "Measure what every variant of the scenes' layers costs and errs by on this device: the table that a scene's "
        "max_error is kept by");
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
