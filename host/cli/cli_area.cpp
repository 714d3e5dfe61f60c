#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "tools/area_error.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct AreaArguments {
    std::filesystem::path scene;
    AreaOptions options;
    std::optional<double> within;
    bool json = false;
};

/// The fewest points that keep 99% of the pixels within so many degrees.
const TapsError* fewest_within(const AreaErrors& errors, double degrees) {
    const TapsError* best = nullptr;
    for (const TapsError& row : errors.taps)
        if (row.degrees.not_finite == 0 && row.degrees.p99 <= degrees && (best == nullptr || row.taps < best->taps))
            best = &row;
    return best;
}

void print_text(const AreaErrors& errors, int own) {
    fmt::print("{} pixels, each integrated at 32 x 32 points in {}; {} drawn ones passed over\n\n",
               errors.unbumped.samples, errors.fp64 ? "double" : "float", errors.passed_over);
    fmt::print("  {:<12}{:>10}{:>24}{:>10}\n", "taps", "ns/pixel", "degrees off: median", "99%");
    fmt::print("  {:<12}{:>10}{:>24.3g}{:>10.3g}\n", "no bumps", "", errors.unbumped.median, errors.unbumped.p99);
    for (const TapsError& row : errors.taps)
        fmt::print("  {:<12}{:>10.2f}{:>24.3g}{:>10.3g}{}\n", row.taps, row.ns, row.degrees.median, row.degrees.p99,
                   row.taps == own ? "  (the scene's)" : "");
}

nlohmann::json json_of(const ErrorStats& stats) {
    return {{"median", stats.median}, {"p99", stats.p99}, {"max", stats.max}, {"not_finite", stats.not_finite}};
}

void print_json(const AreaErrors& errors, int own, int seed) {
    nlohmann::json rows = nlohmann::json::array();
    for (const TapsError& row : errors.taps)
        rows.push_back({{"taps", row.taps}, {"ns_per_pixel", row.ns}, {"degrees", json_of(row.degrees)}});
    fmt::print("{}\n", json_text(nlohmann::json{{"pixels", errors.unbumped.samples},
                                                {"points", 1024},
                                                {"seed", seed},
                                                {"passed_over", errors.passed_over},
                                                {"double", errors.fp64},
                                                {"unbumped", json_of(errors.unbumped)},
                                                {"scene_taps", own},
                                                {"taps", rows}}));
}

void area(const AreaArguments& arguments) {
    const Scene scene = load_scene(arguments.scene);
    const AreaErrors errors = measure_area(scene, arguments.options);
    if (arguments.json)
        print_json(errors, scene.filter.taps, arguments.options.seed);
    else
        print_text(errors, scene.filter.taps);
    if (!arguments.within) return;
    const TapsError* fewest = fewest_within(errors, *arguments.within);
    if (fewest == nullptr)
        throw Error(
            fmt::format("no number of taps that was measured keeps 99% of the pixels within {} degrees of "
                        "their areas",
                        *arguments.within));
    if (!arguments.json)
        fmt::print("\n[filter] taps = {} keeps 99% of the pixels within {} degrees\n", fewest->taps, *arguments.within);
}

}  // namespace

void add_area(CLI::App& app) {
    auto arguments = std::make_shared<AreaArguments>();
    CLI::App* command = app.add_subcommand(
        "area",
        "Measure what a scene's normals miss of the areas that its pixels show, and what more points in them cost");
    command->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
    command->add_option("--taps", arguments->options.taps, "numbers of [filter] taps to compare, with commas")
        ->delimiter(',')
        ->capture_default_str()
        ->check(CLI::Range(1, 64));
    command
        ->add_option("--within", arguments->within,
                     "say which is the fewest that keeps 99% of the pixels so near; exit code 1 where none does")
        ->type_name("DEGREES")
        ->check(CLI::PositiveNumber);
    command->add_option("--frame", arguments->options.frame, "frame number, for scenes of a sequence");
    add_device_option(*command, arguments->options.device);
    command->add_option("--repeat", arguments->options.repeat, "runs of each kernel; their median counts")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000));
    command->add_option("--sample", arguments->options.sample, "pixels whose area is integrated")
        ->capture_default_str()
        ->check(CLI::Range(1, 1 << 20));
    command->add_option("--seed", arguments->options.seed, "which pixels")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    command->add_flag("--json", arguments->json, "print as JSON");
    command->callback([arguments] { area(*arguments); });
}

}  // namespace wrinkle::cli
