#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/explain_area.h"
#include "cli/explain_budget.h"
#include "cli/format_option.h"
#include "cli/frame_list.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "device/kernel_sources.h"
#include "device/program.h"
#include "io/camera_file.h"
#include "layers/kinds.h"
#include "resources/volume_heap.h"
#include "run/bin_report.h"
#include "run/open_frame.h"
#include "run/pass_impl.h"
#include "tools/frame_lights.h"
#include "tools/metal_pictures.h"
#include "wrinkle/error.h"

#include "layout.h"

namespace wrinkle::cli {

namespace {

struct ExplainArguments {
    std::filesystem::path scene;
    std::string device;
    int lanes = 0;
    std::optional<int> frame;
    std::optional<double> max_error;
    std::vector<std::string> set, formats;
    bool full = false, no_source = false, json = false;
};

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "-" : text;
}

/// Warns of a camera that "wrinkle run" would refuse: it makes no difference to the plan.
void warn_of_camera(const Scene& scene, const GBufferReader& reader, const FrameCamera& camera) {
    try {
        check_residual(camera, scene.camera.max_residual, reader);
    } catch (const Error& error) { fmt::print(stderr, "wrinkle: warning: {}\n", error.what()); }
}

void print_bins(const char* what, const BinReport& bins) {
    fmt::print("\ntables of {}: {} rows, {:.1f} MB of tables, bounds and room for lists on the device\n", what,
               bins.rows, static_cast<double>(bins.bytes) / 1e6);
    fmt::print("  bins: tiles of {0} x {1} pixels, listed from the top down: all, {2} x {3}, {4} x {5}, {0} x {1}\n",
               WR_TILE_WIDTH, WR_TILE_HEIGHT, WR_SUPER_WIDTH, WR_SUPER_HEIGHT, 4 * WR_TILE_WIDTH, 4 * WR_TILE_HEIGHT);
    fmt::print("  lists of this frame: {} of {} tiles have {}; {:.1f} a tile that has any, at most {}; {} bytes\n",
               bins.touched, bins.tiles, what, static_cast<double>(bins.entries) / std::max<double>(bins.touched, 1),
               bins.longest, sizeof(std::uint32_t) * bins.entries);
    if (bins.inherited > 0) fmt::print("  {} tiles share a larger tile's list, for want of room\n", bins.inherited);
}

std::vector<VolumeReport> volumes_of(const Plan& plan) {
    std::vector<VolumeReport> reports;
    for (const PlannedTexture& texture : plan.textures)
        if (texture.kind == TexelKind::volume || texture.kind == TexelKind::volume_smooth)
            reports.push_back(volume_report(texture));
    return reports;
}

void print_volumes(const std::vector<VolumeReport>& volumes) {
    if (!volumes.empty()) fmt::print("\nvolumes: blocks of 8 x 8 x 8 voxels, in the order of the layers\n");
    for (const VolumeReport& v : volumes)
        fmt::print("  \"{}\" of {}: {} x {} x {} blocks, {} stored; with {} coarser levels {:.1f} MB on the device\n",
                   v.info.grid, v.info.channels == 3 ? "vectors" : "values", v.blocks[0], v.blocks[1], v.blocks[2],
                   v.stored, v.levels, static_cast<double>(v.bytes) / 1e6);
}

nlohmann::json volumes_json(const std::vector<VolumeReport>& volumes) {
    nlohmann::json all = nlohmann::json::array();
    for (const VolumeReport& v : volumes)
        all.push_back({{"grid", v.info.grid},
                       {"channels", v.info.channels},
                       {"blocks", v.blocks},
                       {"stored", v.stored},
                       {"levels", v.levels},
                       {"bytes", v.bytes}});
    return all;
}

/// Prints the numbers that the kernels read from their buffer, and the index of the first of each.
void print_numbers(const Plan& plan, const NumberSource& source) {
    if (!plan.numbers.empty()) fmt::print("\nnumbers of the scene, in the order of the kernels' buffer\n");
    std::size_t first = 0;
    for (const PlannedNumbers& planned : plan.numbers) {
        fmt::print("  {:>4}  {}: {}\n", first, planned.name, fmt::join(numbers_of(planned, source), ", "));
        first += planned.count;
    }
}

PlanOptions options_of(const std::optional<Budget>& budget) {
    PlanOptions options;
    if (budget && !budget->choice().fp64) options.precision = budget->choice().precision;
    return options;
}

/// What a device is needed for; none is opened for the rest.
struct OnDevice {
    std::optional<Device> device;
    std::optional<Budget> budget;  ///< the scene's, if it has one
    FrameBins bins;                ///< the lists of the frame's tiles, if the scene has tables of decals or lights
};

std::string flags_of(const Device& device, const std::optional<Budget>& budget) {
    const bool fp64 = budget && budget->choice().fp64;
    return build_flags({fp64 ? std::min(device.info.lanes, 8) : device.info.lanes, fp64});
}

nlohmann::json device_json(const OnDevice& on) {
    if (!on.device) return {};
    const DeviceInfo& info = on.device->info;
    return {{"name", info.name}, {"lanes", info.lanes}, {"flags", flags_of(*on.device, on.budget)}};
}

nlohmann::json bins_json(const std::optional<BinReport>& bins) {
    if (!bins) return {};
    return {{"rows", bins->rows},          {"bytes", bins->bytes},     {"tiles", bins->tiles},
            {"touched", bins->touched},    {"entries", bins->entries}, {"longest", bins->longest},
            {"inherited", bins->inherited}};
}

void print_json(const Plan& plan, const Scene& scene, double operations, const OnDevice& on,
                const std::vector<VolumeReport>& volumes) {
    const auto& [device, budget, bins] = on;
    nlohmann::json sections = nlohmann::json::array();
    for (const SectionSummary& section : plan.sections)
        sections.push_back({{"stage", section.stage},
                            {"title", section.title},
                            {"planes", section.planes},
                            {"operations_per_pixel", section.operations}});
    fmt::print("{}\n", json_text(nlohmann::json{{"inputs", plan.inputs},
                                                {"outputs", plan.outputs},
                                                {"device", device_json(on)},
                                                {"bytes_per_pixel", plan.bytes},
                                                {"operations_per_pixel", operations},
                                                {"sections", sections},
                                                {"bins", bins_json(bins.decals)},
                                                {"light_bins", bins_json(bins.lights)},
                                                {"volumes", volumes_json(volumes)},
                                                {"areas", areas_json(scene, device)},
                                                {"budget", budget ? choice_json(*budget) : nlohmann::json()},
                                                {"source", plan.source}}));
}

void explain(const ExplainArguments& arguments) {
    const scene::SceneFile file = load_scene_file(arguments.scene, {.set = arguments.set, .frame = arguments.frame});
    Scene scene = file.scene;
    if (arguments.max_error) scene.budget.max_error = arguments.max_error;
    check_frame_pattern(frame_files(file), "--frame", arguments.frame.has_value());
    const int number = arguments.frame.value_or(0);
    if (wants_lights(scene)) scene = with_lights(scene, find_lights(scene, number));
    if (wants_metals(scene)) scene = with_metals(scene, metals_of_frame(scene, number));
    GBufferReader reader = open_frame(scene, number);
    const FrameCamera camera = camera_of_frame(scene, reader, number, CameraCheck::none);
    const Frame frame = frame_of(scene, reader, camera);
    warn_of_camera(scene, reader, camera);
    OnDevice on;
    const auto open = [&] {
        if (!on.device) on.device = open_device(arguments.device, arguments.lanes);
        return *on.device;
    };
    if (!arguments.device.empty() || arguments.lanes != 0) open();
    if (scene.budget.max_error) on.budget.emplace(scene, camera_kind(frame.camera, frame.size), costs_of(open().info));
    Frame stored = frame;
    stored.formats = formats_of(arguments.formats);
    const Plan plan = plan_for(scene, stored, options_of(on.budget));
    if (plan.tiles) on.bins = bin_report(open(), scene, frame, reader);
    double operations = 0;
    for (const SectionSummary& section : plan.sections) operations += section.operations;
    const std::vector<VolumeReport> volumes = volumes_of(plan);
    if (arguments.json) {
        print_json(plan, scene, operations, on, volumes);
        return;
    }
    fmt::print("{}: {} x {} pixels\n\n", scene.file.string(), frame.size.width, frame.size.height);
    fmt::print("reads   {}\nwrites  {}\n", join(plan.inputs), join(plan.outputs));
    fmt::print("textures {}, decals {}; neighbouring rows {}\n\n", plan.textures.size(), plan.decals.size(),
               plan.neighbours ? "needed" : "not needed");
    fmt::print("  {:<6}{:<52}{:>12}  {}\n", "stage", "step", "ops/pixel", "channels");
    for (const SectionSummary& section : plan.sections)
        fmt::print("  {:<6}{:<52}{:>12.0f}  {}\n", section.stage, section.title, section.operations,
                   join(section.planes));
    fmt::print("\nexpected per pixel, where nothing is skipped: {:.0f} bytes of planes, {:.0f} operations\n",
               plan.bytes, operations);
    if (on.device)
        fmt::print("on {}, {} lanes: {}\n", on.device->info.name, on.device->info.lanes,
                   flags_of(*on.device, on.budget));
    if (on.budget) print_choice(*on.budget);
    print_areas(scene, on.device);
    if (scene.budget.max_area_error)
        fmt::print(
            "\nmax_area_error {} degrees: a run measures which is the fewest taps, of {} at most, that keep it\n",
            *scene.budget.max_area_error, scene.filter.taps);
    if (on.bins.decals) print_bins("decals", *on.bins.decals);
    if (on.bins.lights) print_bins("lights", *on.bins.lights);
    print_volumes(volumes);
    print_numbers(plan, {scene, frame.cryptomatte});
    if (arguments.no_source) return;
    fmt::print("\n{}", arguments.full ? expand_includes(plan.source, "evaluate.cl") : plan.source);
}

}  // namespace

void add_explain(CLI::App& app) {
    auto arguments = std::make_shared<ExplainArguments>();
    CLI::App* command =
        app.add_subcommand("explain", "Print a scene's plan: stages, channels, expected cost, and the kernel source");
    command->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
    command->add_option("--frame", arguments->frame, "frame number, for scenes of a sequence");
    add_set_option(*command, arguments->set);
    add_format_option(*command, arguments->formats);
    add_max_error_option(*command, arguments->max_error, "explains what a run under that budget starts with");
    add_device_option(*command, arguments->device);
    add_lanes_option(*command, arguments->lanes);
    command->add_flag("--full", arguments->full, "print the source with every concept file in it");
    command->add_flag("--no-source", arguments->no_source, "print the plan only");
    command->add_flag("--json", arguments->json, "print as JSON");
    command->callback([arguments] { explain(*arguments); });
}

}  // namespace wrinkle::cli
