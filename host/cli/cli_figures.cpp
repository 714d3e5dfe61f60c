#include <fmt/format.h>

#include <memory>

#include "base/same_file.h"
#include "cli/commands.h"
#include "cli/options.h"
#include "layers/kinds.h"
#include "scene/check_scene.h"
#include "tools/draw_figure.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

struct FigureArguments {
    std::vector<std::filesystem::path> files;
    std::filesystem::path directory = "out";
    std::string device;
};

void figures(const FigureArguments& arguments) {
    std::vector<Figure> figures;
    for (const std::filesystem::path& file : arguments.files) figures.push_back(load_figure(file));
    std::error_code failed;
    std::filesystem::create_directories(arguments.directory, failed);
    if (failed)
        throw Error(
            fmt::format("cannot make the output folder {}: {}", arguments.directory.string(), failed.message()));
    const Device device = Device::open(arguments.device);
    for (const Figure& figure : figures) {
        const std::filesystem::path picture = arguments.directory / figure.scene.file.stem() += ".png";
        refuse_to_replace(picture, scene::files_of(layer_kinds(), figure.scene));
        draw_figure(device, figure, picture);
        fmt::print("wrote {}\n", picture.string());
    }
}

}  // namespace

void add_figures(CLI::App& app) {
    auto arguments = std::make_shared<FigureArguments>();
    CLI::App* command =
        app.add_subcommand("figures", "Draw figures: a scene several times side by side, each with some of its layers");
    command->add_option("FIGURE", arguments->files, "figure files (TOML), each becomes DIR/NAME.png")->required();
    command->add_option("-o,--output", arguments->directory, "folder for the pictures, made if missing")
        ->type_name("DIR")
        ->capture_default_str();
    add_device_option(*command, arguments->device);
    command->callback([arguments] { figures(*arguments); });
}

}  // namespace wrinkle::cli
