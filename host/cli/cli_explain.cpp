#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/frame_list.h"
#include "device/kernel_sources.h"
#include "io/frame_path.h"
#include "run/pass_impl.h"
#include "run/render.h"

namespace wrinkle::cli {

namespace {

struct ExplainArguments {
    std::filesystem::path scene;
    int frame = 1;
    bool full = false, no_source = false, json = false;
};

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "-" : text;
}

void print_json(const Plan& plan, double operations) {
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
                                      {"source", plan.source}}
                           .dump(2));
}

void explain(const ExplainArguments& arguments) {
    const Scene scene = load_scene(arguments.scene);
    const Frame frame = describe_frame(scene, arguments.frame);
    const Plan plan = plan_for(scene, frame, {});
    double operations = 0;
    for (const SectionSummary& section : plan.sections) operations += section.operations;
    if (arguments.json) {
        print_json(plan, operations);
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
    if (arguments.no_source) return;
    fmt::print("\n{}", arguments.full ? expand_includes(plan.source, "evaluate.cl") : plan.source);
}

}  // namespace

void add_explain(CLI::App& app) {
    auto arguments = std::make_shared<ExplainArguments>();
    CLI::App* command =
        app.add_subcommand("explain", "Print a scene's plan: stages, channels, expected cost, and the kernel source");
    command->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
    command->add_option("--frame", arguments->frame, "frame number, for scenes of a sequence")->capture_default_str();
    command->add_flag("--full", arguments->full, "print the source with every concept file in it");
    command->add_flag("--no-source", arguments->no_source, "print the plan only");
    command->add_flag("--json", arguments->json, "print as JSON");
    command->callback([arguments] { explain(*arguments); });
}

}  // namespace wrinkle::cli
