#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <optional>

#include "base/same_file.h"
#include "cli/checks.h"
#include "cli/commands.h"
#include "cli/frame_list.h"
#include "cli/options.h"
#include "io/camera_file.h"
#include "io/frame_path.h"
#include "io/gbuffer_reader.h"
#include "io/whole_planes.h"
#include "layers/kinds.h"
#include "run/open_frame.h"
#include "scene/check_scene.h"
#include "tools/scatter.h"

namespace wrinkle::cli {

namespace {

const std::map<std::string, ProjectorShape> kShapes{
    {"box", ProjectorShape::box}, {"sphere", ProjectorShape::sphere}, {"cone", ProjectorShape::cone}};

struct ScatterArguments {
    std::filesystem::path scene, file = "decals.csv";
    std::optional<int> frame;
    std::vector<std::string> set;
    ScatterOptions options;
    std::vector<double> size{0.1, 0.2};
    std::vector<std::uint32_t> atlas{1, 1};
    std::vector<std::string> shapes{"box"};
    bool replace = false;
};

/// The planes that decals are placed by: normals, and depth or positions, as the scene takes its geometry from.
std::vector<std::string> planes_of(Geometry geometry) {
    std::vector<std::string> planes{"normal.x", "normal.y", "normal.z"};
    if (geometry != Geometry::position) planes.emplace_back("depth");
    if (geometry != Geometry::depth) planes.insert(planes.end(), {"position.x", "position.y", "position.z"});
    return planes;
}

void scatter(ScatterArguments arguments) {
    const scene::SceneFile file = load_scene_file(arguments.scene, {.set = arguments.set, .frame = arguments.frame});
    const Scene& scene = file.scene;
    refuse_to_replace(arguments.file, scene::files_of(layer_kinds(), scene));
    check_frame_pattern(frame_files(file), "--frame", arguments.frame.has_value());
    const int number = arguments.frame.value_or(0);
    GBufferReader reader = open_frame(scene, number);
    refuse_to_replace(arguments.file, std::array{reader.path(), frame_path(scene.camera.file, number)});
    const Frame frame = frame_of(scene, reader, camera_of_frame(scene, reader, number));
    std::vector<std::string> names;
    for (const std::string& name : planes_of(scene.gbuffer.geometry))
        if (reader.has_plane(name)) names.push_back(name);
    const auto pixels = io::read_whole_planes(reader, names);
    ScatterOptions& options = arguments.options;
    options.half_size = {arguments.size[0], arguments.size[1]};
    options.atlas = {arguments.atlas[0], arguments.atlas[1]};
    options.shapes.clear();
    for (const std::string& shape : arguments.shapes) options.shapes.push_back(kShapes.at(shape));
    if (arguments.replace) options.mode = ProjectorMode::replace;
    const std::vector<Projector> rows = scatter_decals(options, frame, {pixels.begin(), pixels.end()});
    save_decals(arguments.file, rows);
    fmt::print("wrote {}: {} decals{}\n", arguments.file.string(), rows.size(),
               rows.size() < options.count
                   ? fmt::format("; {} did not fit with that spacing", options.count - rows.size())
                   : "");
}

}  // namespace

void add_scatter(CLI::App& app) {
    auto arguments = std::make_shared<ScatterArguments>();
    ScatterOptions& options = arguments->options;
    CLI::App* command =
        app.add_subcommand("scatter", "Place decals on a scene's frame at random, a Poisson disk sample, into a table");
    command->add_option("SCENE", arguments->scene, "scene file (TOML); its layers do not matter")->required();
    command->add_option("-o,--output", arguments->file, "the table: TOML if named .toml, else CSV")
        ->type_name("FILE")
        ->capture_default_str();
    command->add_option("--frame", arguments->frame, "frame number, for scenes of a sequence");
    add_set_option(*command, arguments->set);
    command->add_option("--count", options.count, "decals, at most")
        ->capture_default_str()
        ->check(CLI::Range(1, 10'000'000));
    command->add_option("--seed", options.seed, "the same seed gives the same table")->capture_default_str();
    command->add_option("--spacing", options.spacing, "least distance of centres, metres")
        ->capture_default_str()
        ->check(not_negative());
    command->add_option("--size", arguments->size, "half size, from and to, metres")
        ->expected(2)
        ->capture_default_str()
        ->check(positive());
    command->add_flag("--pixels", options.pixels, "--spacing and --size are in pixels");
    command->add_option("--depth", options.depth, "metres for a height of 1, as a share of the half size")
        ->capture_default_str()
        ->check(finite());
    command->add_option("--thickness", options.thickness, "half size along the normal, as a share of the half size")
        ->capture_default_str()
        ->check(positive());
    command->add_option("--textures", options.textures, "textures to draw from")
        ->capture_default_str()
        ->check(CLI::Range(1, 1'000'000));
    command->add_option("--atlas", arguments->atlas, "columns and rows of each texture; a decal gets one field")
        ->expected(2)
        ->check(CLI::Range(1, 10'000));
    std::vector<std::string> shapes;
    for (const auto& [name, shape] : kShapes) shapes.push_back(name);
    command->add_option("--shapes", arguments->shapes, "shapes to draw from: box, sphere, cone")
        ->type_name("SHAPE")
        ->capture_default_str()
        ->check(one_of(shapes));
    command->add_flag("--replace", arguments->replace, "decals replace those before them instead of adding up");
    command->add_option("--opacity", options.opacity, "of each")->capture_default_str()->check(zero_to_one());
    command->callback([arguments] { scatter(*arguments); });
}

}  // namespace wrinkle::cli
