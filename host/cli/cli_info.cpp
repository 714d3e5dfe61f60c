#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/names.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "io/channel_names.h"
#include "io/info.h"
#include "layers/kinds.h"
#include "tools/frame_warnings.h"
#include "tools/readiness.h"

namespace wrinkle::cli {

namespace {

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

const char* type_name(ChannelType type) {
    return type == ChannelType::half    ? "16-bit floats"
           : type == ChannelType::whole ? "32-bit integers"
                                        : "32-bit floats";
}

std::vector<std::string> channels_of(const GBufferInfo& info, ChannelType type) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < info.channels.size(); ++i)
        if (info.types[i] == type) names.push_back(info.channels[i]);
    return names;
}

/// What is done to roles before they are used, and what spoils them; then what is said of the scene.
std::vector<std::string> remarks(const GBufferInfo& info, const std::vector<std::string>& of_scene) {
    std::vector<std::string> lines;
    if (info.packed_normals) lines.emplace_back("normals are stored in [0,1] and unpacked");
    if (info.roles.camera_space_normals) lines.emplace_back("normals are in camera space, and turned by the camera");
    if (info.roles.v_down && info.roles.has_role("uv")) lines.emplace_back("v grows downwards, and is turned");
    if (info.roles.has_role("object") && info.objects == io::ObjectStorage::bits)
        lines.emplace_back("object numbers are the bits of floats");
    for (const RoleStats& role : info.stats)
        if (role.mixed > 0)
            lines.push_back(fmt::format(
                "object: {:.2g}% of the pixels hold no whole number but the average of several, and belong to none",
                100.0 * static_cast<double>(role.mixed) / static_cast<double>(info.measured)));
    if (const std::string problem = uv_problem(info); !problem.empty()) lines.push_back(problem);
    if (info.camera) lines.insert(lines.end(), info.camera->doubts.begin(), info.camera->doubts.end());
    lines.insert(lines.end(), of_scene.begin(), of_scene.end());
    return lines;
}

void print_text(const GBufferInfo& info, const std::vector<std::string>& of_scene) {
    fmt::print("{}: {} x {}, {} part{}, {} channels, written by {}\n", info.file.string(), info.size.width,
               info.size.height, info.parts, info.parts == 1 ? "" : "s", info.channels.size(),
               writer_name(info.roles.writer));
    for (const ChannelType type : {ChannelType::half, ChannelType::single, ChannelType::whole})
        if (const auto of_type = channels_of(info, type); !of_type.empty())
            fmt::print("  {}: {}\n", type_name(type), io::describe_channels(of_type));
    if (info.views.size() > 1)
        fmt::print("  views: {}; this is {} ([gbuffer] view chooses)\n", join(info.views), info.view);
    if (info.measured < info.pixels())
        fmt::print("  measured: {:.0f}% of the rows, spread over the frame\n",
                   100.0 * static_cast<double>(info.measured) / static_cast<double>(info.pixels()));
    fmt::print("\n");
    fmt::print("  {:<22}{:<34}{:>13}{:>13}{:>12}\n", "role", "channels", "least", "largest", "invalid");
    for (const RoleStats& role : info.stats)
        fmt::print(
            "  {:<22}{:<34}{:>13.5g}{:>13.5g}{:>11.2f}%\n", role.role,
            role.channels.empty() ? ""
                                  : fmt::format("{}{}", role.channels.front(), role.channels.size() > 1 ? " ..." : ""),
            role.min, role.max,
            100.0 * static_cast<double>(role.invalid) / static_cast<double>(std::max<std::uint64_t>(info.measured, 1)));
    for (const std::string& line : remarks(info, of_scene)) fmt::print("  {}\n", line);
    if (info.roles.has_role("depth")) {
        const bool measured = info.camera && info.camera->depth;
        const DepthKind kind = measured ? *info.camera->depth : info.roles.depth;
        fmt::print("  depth is {} ({})\n",
                   kind == DepthKind::ray ? "the distance along the ray" : "planar (along the view axis)",
                   measured ? "measured against the positions" : "by the writer");
    }
    if (!info.cryptomatte_problem.empty()) fmt::print("  {}\n", info.cryptomatte_problem);
    if (!info.cryptomatte_names.empty()) fmt::print("  Cryptomatte names: {}\n", join(info.cryptomatte_names));
    if (!info.light_pictures.empty()) fmt::print("  pictures of lights: {}\n", join(info.light_pictures));

    if (info.camera) {
        fmt::print("\ncamera: {}\n", info.camera->origin);
        if (info.camera->residual)
            fmt::print("  positions reproject within {:.4g} pixel (median), {:.4g} (p99), {} samples\n",
                       info.camera->residual->median, info.camera->residual->p99, info.camera->residual->count);
        else
            fmt::print("  no positions to check it against\n");
        if (!info.camera_problem.empty()) fmt::print("  refused: {}\n", info.camera_problem);
    } else {
        fmt::print("\ncamera: none found{}{}\n", info.camera_problem.empty() ? "" : ": ", info.camera_problem);
    }

    fmt::print("\n");
    for (const Readiness& use : readiness(info))
        fmt::print(
            "  {:<36}{}{}\n", use.use, use.missing.empty() ? "ready" : "lacks " + join(use.missing),
            use.defaults.empty() ? "" : fmt::format(" (the scene's constants stand in for {})", join(use.defaults)));
}

void print_json(const GBufferInfo& info, const std::vector<std::string>& of_scene) {
    nlohmann::json roles = nlohmann::json::array(), uses = nlohmann::json::array(), camera;
    for (const RoleStats& role : info.stats)
        roles.push_back({{"role", role.role},
                         {"mixed", role.mixed},
                         {"channels", role.channels},
                         {"min", role.min},
                         {"max", role.max},
                         {"invalid", role.invalid}});
    for (const Readiness& use : readiness(info))
        uses.push_back({{"use", use.use}, {"missing", use.missing}, {"defaults", use.defaults}});
    nlohmann::json types = nlohmann::json::array();
    for (const ChannelType type : info.types) types.push_back(type_name(type));
    if (info.camera) {
        camera["origin"] = info.camera->origin;
        if (info.camera->residual)
            camera["residual_pixels"] = {{"median", info.camera->residual->median},
                                         {"p99", info.camera->residual->p99},
                                         {"samples", info.camera->residual->count}};
    }
    if (!info.camera_problem.empty()) camera["problem"] = info.camera_problem;
    fmt::print("{}\n", json_text(nlohmann::json{{"file", info.file.string()},
                                                {"writer", std::string(writer_name(info.roles.writer))},
                                                {"width", info.size.width},
                                                {"height", info.size.height},
                                                {"parts", info.parts},
                                                {"channels", info.channels},
                                                {"types", types},
                                                {"views", info.views},
                                                {"view", info.view},
                                                {"measured_pixels", info.measured},
                                                {"remarks", remarks(info, of_scene)},
                                                {"roles", roles},
                                                {"camera", camera},
                                                {"uses", uses},
                                                {"cryptomatte", info.cryptomatte_names},
                                                {"light_pictures", info.light_pictures}}));
}

struct InfoArguments {
    std::filesystem::path file, camera;
    std::optional<int> frame;
    std::vector<std::string> set;
    bool json = false;
};

void info(const InfoArguments& arguments) {
    GBufferSource source;
    std::optional<CameraSource> camera;
    std::optional<Scene> scene;
    std::vector<std::filesystem::path> of_layers;
    if (lower(arguments.file.extension().string()) == ".toml") {
        const scene::SceneFile file = load_scene_file(arguments.file, {.set = arguments.set, .frame = arguments.frame});
        scene = file.scene;
        source = scene->gbuffer;
        camera = scene->camera;
        of_layers = file.frame_files;
    } else {
        source.file = arguments.file;
    }
    if (!arguments.camera.empty()) camera.emplace().file = arguments.camera;
    std::vector<std::filesystem::path> files = frame_files(source, camera);
    files.insert(files.end(), of_layers.begin(), of_layers.end());
    check_frame_pattern(files, "--frame", arguments.frame.has_value());
    const int number = arguments.frame.value_or(0);
    const GBufferInfo gathered = gather_info(source, camera, number);
    std::vector<std::string> of_scene;
    if (scene && arguments.camera.empty()) of_scene = scene_warnings(*scene, number);
    if (arguments.json)
        print_json(gathered, of_scene);
    else
        print_text(gathered, of_scene);
}

}  // namespace

void add_info(CLI::App& app) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand(
        "info", "Print what a G-buffer holds: roles, ranges, camera and its residual, and what each layer kind lacks");
    command
        ->add_option("FILE", arguments->file,
                     "image file, usually EXR; or a scene (.toml): its frame, with the roles and the camera it names")
        ->required();
    command
        ->add_option("--camera", arguments->camera,
                     "camera file (JSON with view and proj); else the scene's, FILE.camera.json, the header's, or one "
                     "solved from the positions")
        ->type_name("FILE");
    command->add_option("--frame", arguments->frame, "which frame, where the name has #### or %04d");
    add_set_option(*command, arguments->set);
    command->add_flag("--json", arguments->json, "print as JSON");
    command->callback([arguments] { info(*arguments); });
}

}  // namespace wrinkle::cli
