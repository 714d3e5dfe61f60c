#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/commands.h"
#include "cli/frame_list.h"
#include "device/kernel_sources.h"
#include "io/camera_file.h"
#include "io/frame_path.h"
#include "run/pass_impl.h"
#include "run/render.h"
#include "run/volume_heap.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct ExplainArguments {
    std::filesystem::path scene;
    std::optional<int> frame;
    bool full = false, no_source = false, json = false;
};

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "-" : text;
}

/// What the lists of the frame's tiles hold, if the scene has tables of decals.
std::optional<BinReport> bins_of(const Scene& scene, const Frame& frame, const Plan& plan, int number) {
    if (plan.tables.empty()) return std::nullopt;
    return bin_report(scene, frame, number);
}

/// A camera that "wrinkle run" refuses is told of; the plan is the same.
void warn_of_camera(const Scene& scene, int number) {
    const GBufferReader reader(frame_path(scene.gbuffer.file, number), scene.gbuffer);
    const FrameCamera camera = read_frame_camera(scene.camera, reader, number);
    try {
        check_residual(camera, scene.camera.max_residual, reader);
    } catch (const Error& error) { fmt::print(stderr, "wrinkle: warning: {}\n", error.what()); }
}

void print_bins(const Plan& plan, const BinReport& bins) {
    fmt::print("\ntables of decals: {} rows, {:.1f} MB of tables, bounds and room for lists on the device\n",
               plan.projectors, static_cast<double>(bins.bytes) / 1e6);
    fmt::print("  bins: tiles of {} x {} pixels, listed from the top down: all, 256 x 128, 64 x 32, {} x {}\n",
               DecalBins::kTileWidth, DecalBins::kTileHeight, DecalBins::kTileWidth, DecalBins::kTileHeight);
    fmt::print("  lists of this frame: {} of {} tiles have decals; {:.1f} a tile that has any, at most {}; {} bytes\n",
               bins.touched, bins.tiles, static_cast<double>(bins.entries) / std::max<double>(bins.touched, 1),
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
        fmt::print("  \"{}\" of {}: {} x {} x {} blocks, {} stored, {:.1f} MB on the device\n", v.info.grid,
                   v.info.channels == 3 ? "vectors" : "values", v.blocks[0], v.blocks[1], v.blocks[2], v.stored,
                   static_cast<double>(v.bytes) / 1e6);
}

nlohmann::json volumes_json(const std::vector<VolumeReport>& volumes) {
    nlohmann::json all = nlohmann::json::array();
    for (const VolumeReport& v : volumes)
        all.push_back({{"grid", v.info.grid},
                       {"channels", v.info.channels},
                       {"blocks", v.blocks},
                       {"stored", v.stored},
                       {"bytes", v.bytes}});
    return all;
}

void print_json(const Plan& plan, double operations, const std::optional<BinReport>& bins,
                const std::vector<VolumeReport>& volumes) {
    nlohmann::json lists;
    if (bins)
        lists = {{"rows", plan.projectors},     {"bytes", bins->bytes},     {"tiles", bins->tiles},
                 {"touched", bins->touched},    {"entries", bins->entries}, {"longest", bins->longest},
                 {"inherited", bins->inherited}};
    nlohmann::json sections = nlohmann::json::array();
    for (const SectionSummary& section : plan.sections)
        sections.push_back({{"stage", section.stage},
                            {"title", section.title},
                            {"planes", section.planes},
                            {"operations_per_pixel", section.operations}});
    fmt::print("{}\n", nlohmann::json{{"inputs", plan.inputs},
                                      {"outputs", plan.outputs},
                                      {"bytes_per_pixel", plan.bytes},
                                      {"operations_per_pixel", operations},
                                      {"sections", sections},
                                      {"bins", lists},
                                      {"volumes", volumes_json(volumes)},
                                      {"source", plan.source}}
                           .dump(2));
}

void explain(const ExplainArguments& arguments) {
    const Scene scene = load_scene(arguments.scene);
    check_frame_pattern(frame_files(scene.gbuffer, scene.camera), "--frame", arguments.frame.has_value());
    const int number = arguments.frame.value_or(0);
    const Frame frame = describe_frame(scene, number);
    warn_of_camera(scene, number);
    const Plan plan = plan_for(scene, frame, {});
    double operations = 0;
    for (const SectionSummary& section : plan.sections) operations += section.operations;
    const std::optional<BinReport> bins = bins_of(scene, frame, plan, number);
    const std::vector<VolumeReport> volumes = volumes_of(plan);
    if (arguments.json) {
        print_json(plan, operations, bins, volumes);
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
    if (bins) print_bins(plan, *bins);
    print_volumes(volumes);
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
    command->add_flag("--full", arguments->full, "print the source with every concept file in it");
    command->add_flag("--no-source", arguments->no_source, "print the plan only");
    command->add_flag("--json", arguments->json, "print as JSON");
    command->callback([arguments] { explain(*arguments); });
}

}  // namespace wrinkle::cli
