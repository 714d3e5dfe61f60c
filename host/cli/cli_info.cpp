#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "base/names.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "io/info.h"
#include "tools/readiness.h"

namespace wrinkle::cli {

namespace {

std::string join(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

void print_text(const GBufferInfo& info) {
    fmt::print("{}: {} x {}, {} part{}, {} channels, written by {}\n\n", info.file.string(), info.size.width,
               info.size.height, info.parts, info.parts == 1 ? "" : "s", info.channels.size(),
               writer_name(info.roles.writer));
    fmt::print("  {:<12}{:<34}{:>13}{:>13}{:>12}\n", "role", "channels", "least", "largest", "invalid");
    for (const RoleStats& role : info.stats)
        fmt::print("  {:<12}{:<34}{:>13.5g}{:>13.5g}{:>11.2f}%\n", role.role,
                   role.channels.empty()
                       ? ""
                       : fmt::format("{}{}", role.channels.front(), role.channels.size() > 1 ? " ..." : ""),
                   role.min, role.max, 100.0 * static_cast<double>(role.invalid) / static_cast<double>(info.pixels()));
    if (info.packed_normals) fmt::print("  normals are stored in [0,1] and unpacked\n");
    if (info.roles.has_role("depth")) {
        const bool measured = info.camera && info.camera->depth;
        const DepthKind kind = measured ? *info.camera->depth : info.roles.depth;
        fmt::print("  depth is {} ({})\n",
                   kind == DepthKind::ray ? "the distance along the ray" : "planar (along the view axis)",
                   measured ? "measured against the positions" : "by the writer");
    }
    if (info.roles.screen_space_normals) fmt::print("  normals are in camera space; give a world-space role\n");
    if (!info.cryptomatte_names.empty()) fmt::print("  Cryptomatte names: {}\n", join(info.cryptomatte_names));

    if (info.camera) {
        fmt::print("\ncamera: {}\n", info.camera->origin);
        if (info.camera->residual)
            fmt::print("  positions reproject within {:.4g} pixel (median), {:.4g} (p99), {} samples\n",
                       info.camera->residual->median, info.camera->residual->p99, info.camera->residual->count);
        else
            fmt::print("  no positions to check it against\n");
    } else {
        fmt::print("\ncamera: none found{}{}\n", info.camera_problem.empty() ? "" : ": ", info.camera_problem);
    }

    fmt::print("\n");
    for (const Readiness& use : readiness(info))
        fmt::print(
            "  {:<36}{}{}\n", use.use, use.missing.empty() ? "ready" : "lacks " + join(use.missing),
            use.defaults.empty() ? "" : fmt::format(" (the scene's constants stand in for {})", join(use.defaults)));
}

void print_json(const GBufferInfo& info) {
    nlohmann::json roles = nlohmann::json::array(), uses = nlohmann::json::array(), camera;
    for (const RoleStats& role : info.stats)
        roles.push_back({{"role", role.role},
                         {"channels", role.channels},
                         {"min", role.min},
                         {"max", role.max},
                         {"invalid", role.invalid}});
    for (const Readiness& use : readiness(info))
        uses.push_back({{"use", use.use}, {"missing", use.missing}, {"defaults", use.defaults}});
    if (info.camera) {
        camera["origin"] = info.camera->origin;
        if (info.camera->residual)
            camera["residual_pixels"] = {{"median", info.camera->residual->median},
                                         {"p99", info.camera->residual->p99},
                                         {"samples", info.camera->residual->count}};
    } else {
        camera["problem"] = info.camera_problem;
    }
    fmt::print("{}\n", nlohmann::json{{"file", info.file.string()},
                                      {"writer", std::string(writer_name(info.roles.writer))},
                                      {"width", info.size.width},
                                      {"height", info.size.height},
                                      {"parts", info.parts},
                                      {"channels", info.channels},
                                      {"roles", roles},
                                      {"camera", camera},
                                      {"uses", uses},
                                      {"cryptomatte", info.cryptomatte_names}}
                           .dump(2));
}

struct InfoArguments {
    std::filesystem::path file, camera;
    std::optional<int> frame;
    bool json = false;
};

void info(const InfoArguments& arguments) {
    GBufferSource source;
    std::optional<CameraSource> camera;
    if (lower(arguments.file.extension().string()) == ".toml") {
        const Scene scene = load_scene(arguments.file);
        source = scene.gbuffer;
        camera = scene.camera;
    } else {
        source.file = arguments.file;
    }
    if (!arguments.camera.empty()) camera.emplace().file = arguments.camera;
    check_frame_pattern(frame_files(source, camera), "--frame", arguments.frame.has_value());
    const GBufferInfo gathered = gather_info(source, camera, arguments.frame.value_or(0));
    if (arguments.json)
        print_json(gathered);
    else
        print_text(gathered);
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
                     "camera file (JSON with view and proj); else the scene's, FILE.camera.json or the header")
        ->type_name("FILE");
    command->add_option("--frame", arguments->frame, "which frame, where the name has #### or %04d");
    command->add_flag("--json", arguments->json, "print as JSON");
    command->callback([arguments] { info(*arguments); });
}

}  // namespace wrinkle::cli
