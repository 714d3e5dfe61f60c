#include <fmt/format.h>

#include <map>
#include <sstream>

#include "base/names.h"
#include "base/text_file.h"
#include "scene/light_json.h"
#include "scene/readers.h"
#include "scene/scene_text.h"
#include "scene/set_values.h"
#include "wrinkle/error.h"
#include "wrinkle/scene.h"

namespace wrinkle::scene {
namespace {

void read_layers(Table& root, LayerKinds kinds, std::vector<Layer>& out) {
    std::map<std::string, std::string> places;
    std::vector<Table> tables = root.tables("layer", out.size());
    root.compiled_in("layer", static_cast<int>(tables.size()));
    out.resize(tables.size());
    for (std::size_t i = 0; i < tables.size(); ++i) {
        Table& table = tables[i];
        read_layer(table, kinds, i + 1, out[i]);
        const std::uint32_t line = table.has("name") ? table.line_of("name") : table.line();
        const auto [earlier, is_new] = places.emplace(
            out[i].name, root.visits() ? fmt::format("layer {}", i + 1) : fmt::format("the layer at line {}", line));
        if (!is_new)
            root.document().problems.add(
                line, fmt::format("the name {} {}is taken by {}; names are unique", quote(out[i].name),
                                  root.visits() ? fmt::format("of layer {} ", i + 1) : "", earlier->second));
    }
}

void read_lights(Table& root, Lighting& out) {
    bool relight_is_sound = true;
    std::uint32_t line = root.line_of("lighting");
    std::optional<Table> lighting = root.table("lighting", "[lighting]");
    if (lighting) read_lighting(*lighting, out);
    std::vector<Table> lights = root.tables("light", out.lights.size());
    out.lights.resize(lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) read_light(lights[i], out.lights[i]);
    if (lighting) {
        if (!root.visits() && !lighting->is_bad("lights") && is_json(out.table_file))
            read_light_json(*lighting, "lights", out.table_file, out.lights);
        relight_is_sound = !lighting->is_bad("relight") && !lighting->is_bad("lights");
        line = lighting->line_of("relight");
    }
    if (!relight_is_sound || root.is_bad("light") || root.is_bad("lighting")) return;
    // A frame's file may say that it has none.
    const bool any = !out.lights.empty() || is_json(out.table_file) || (out.table && !out.table->empty());
    if (out.relight == Relight::off && !lights.empty() && !root.visits())
        root.document().problems.add(lights.front().line(),
                                     "[[light]] has no effect while relighting is off; set relight = \"lit\" or "
                                     "\"ratio\" in [lighting], or remove the lights");
    // A file's lights may be left to those who open its frame: they are fitted to the picture.
    const bool fitted = out.relight == Relight::ratio && !root.visits();
    if (out.relight != Relight::off && !any && out.ambient == Vec3{} && !fitted)
        root.document().problems.add(
            line,
            fmt::format("relight without light: add a [[light]]{}, or set ambient in [lighting], or set relight = "
                        "\"off\"",
                        out.relight == Relight::ratio ? " (\"wrinkle fit-lights\" estimates those of a frame)" : ""));
}

void finish(Table& root) {
    root.finish([](const std::string& key) {
        return key == "figure" || key == "panel" ? "makes this a figure; draw it with \"wrinkle figures\"" : "";
    });
    root.document().problems.throw_if_any();
}

}  // namespace

void require_gbuffer(Table& root) {
    if (!root.has("gbuffer")) root.document().problems.add(0, "needs [gbuffer], at least file = \"frame.exr\"");
}

namespace {

std::string name_of(const std::filesystem::path& file) { return file == "-" ? "standard input" : file.string(); }

std::string text_of(const std::filesystem::path& file) {
    return file == "-" ? read_standard_input() : read_text(file, "a scene file");
}

toml::table parse_scene_text(const std::string& text, const std::string& name) {
    if (text.find('\0') != std::string::npos)
        throw Error(
            fmt::format("{}: is no text, so no scene (TOML); if it is an image, \"wrinkle info\" tells what it "
                        "holds",
                        name));
    toml::table values = parse_toml(text, name);
    if (!values.empty()) return values;
    throw Error(fmt::format("{}: the scene is empty; it needs [gbuffer]", name));
}

}  // namespace

toml::table parse_scene_file(const std::filesystem::path& file) {
    return parse_scene_text(text_of(file), name_of(file));
}

void read_scene(Table& root, LayerKinds kinds, Scene& out) {
    if (auto table = root.table("gbuffer", "[gbuffer]")) read_gbuffer(*table, out.gbuffer);
    if (auto table = root.table("camera", "[camera]", false)) read_camera(*table, out.camera);
    read_layers(root, kinds, out.layers);
    read_lights(root, out.lighting);
    std::uint32_t curvature = 0;
    if (auto table = root.table("filter", "[filter]")) {
        read_filter(*table, out.filter);
        curvature = table->line_of("curvature");
    }
    if (auto table = root.table("output", "[output]")) read_output(*table, out.output);
    if (out.filter.curvature && !out.output.roughness && !out.output.slope_covariance && !root.visits())
        root.document().problems.add(curvature,
                                     "curvature has no effect without roughness or slope_covariance in [output]");
    if (auto table = root.table("budget", "[budget]")) read_budget(*table, out.budget);
}

SceneFile load_scene_file(LayerKinds kinds, const std::filesystem::path& file, const SceneOptions& options) {
    return load_scene_text(kinds, text_of(file), file, options);
}

SceneFile load_scene_text(LayerKinds kinds, const std::string& file_text, const std::filesystem::path& file,
                          const SceneOptions& options) {
    toml::table values = parse_scene_text(file_text, name_of(file));
    for (const std::string& setting : options.set) set_value(values, setting);
    Document document{file.parent_path(), true, Problems(name_of(file))};
    document.frame = options.frame;
    Table root(document, values, "the scene", 1);
    SceneFile out;
    out.scene.file = file;
    require_gbuffer(root);
    try {
        read_scene(root, kinds, out.scene);
        finish(root);
    } catch (const Error& error) {
        if (options.set.empty()) throw;
        throw Error(fmt::format("{}\n(with --set {})", error.what(), fmt::join(options.set, ", --set ")));
    }
    std::ostringstream text;
    text << toml::toml_formatter(values);
    out.text = text.str();
    out.files = std::move(document.files);
    out.kept_files = std::move(document.kept);
    out.frame_files = std::move(document.frame_files);
    return out;
}

Scene parse_scene(LayerKinds kinds, std::string_view text, const std::string& name,
                  const std::filesystem::path& folder) {
    const toml::table values = parse_toml(text, name);
    Document document{folder, true, Problems(name)};
    Table root(document, values, "the scene", 1);
    Scene out;
    read_scene(root, kinds, out);
    finish(root);
    return out;
}

}  // namespace wrinkle::scene
