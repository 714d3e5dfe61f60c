#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "io/frame_path.h"
#include "scene/figure.h"
#include "scene/readers.h"

namespace wrinkle::scene {
namespace {

void read_figure(Table& table, Figure& out) {
    table.read("columns", out.columns, 1, 16);
    if (table.read("crop", out.crop, zero_to_one) && !(out.crop[0] < out.crop[2] && out.crop[1] < out.crop[3]))
        table.complain("crop", "must be [left, top, right, bottom], left < right and top < bottom");
    table.finish();
}

void read_panel(Table& table, const Figure& figure, Panel& out) {
    table.require("caption");
    table.read("caption", out.caption);
    table.choose("picture", out.picture,
                 {{"lit", PanelPicture::lit},
                  {"normal", PanelPicture::normal},
                  {"before", PanelPicture::before},
                  {"condition", PanelPicture::condition}});
    table.require("layers");
    table.read("layers", out.layers);
    std::vector<std::string> known;
    for (const Layer& layer : figure.scene.layers) known.push_back(layer.name);
    for (const std::string& name : out.layers)
        if (std::ranges::find(known, name) == known.end())
            table.complain("layers", fmt::format("names {}, which is no layer of this file{}", quote(name),
                                                 did_you_mean(name, known)));
    table.finish();
}

/// What the pictures that are asked for need of the lighting.
void check_pictures(Table& root, const Figure& figure) {
    const Relight relight = figure.scene.lighting.relight;
    for (const Panel& panel : figure.panels)
        if (panel.picture == PanelPicture::lit && relight == Relight::off) {
            root.document().problems.add(root.line_of("panel"),
                                         "panels show the lit picture; set relight = \"lit\" or \"ratio\" in "
                                         "[lighting], or picture = \"normal\" in each [[panel]]");
            return;
        }
}

}  // namespace

Figure load_figure(LayerKinds kinds, const std::filesystem::path& file) {
    const toml::table values = parse_scene_file(file);
    Document document{file.parent_path(), true, Problems(file.string())};
    Table root(document, values, "the figure", 1);
    Figure out;
    out.scene.file = file;
    require_gbuffer(root);
    read_scene(root, kinds, out.scene);
    if (auto table = root.table("figure", "[figure]")) read_figure(*table, out);
    for (Table& table : root.tables("panel", 0)) read_panel(table, out, out.panels.emplace_back());
    if (out.panels.empty() && !root.is_bad("panel"))
        document.problems.add(0,
                              "needs a [[panel]], at least caption = \"...\" and layers = [] (to evaluate a scene, "
                              "use \"wrinkle run\")");
    check_pictures(root, out);
    if (has_frame_pattern(out.scene.gbuffer.file) || has_frame_pattern(out.scene.camera.file))
        document.problems.add(root.line_of("gbuffer"),
                              "a figure shows one frame: name its files in [gbuffer] and [camera] without a place for "
                              "a number");
    if (out.scene.budget.max_error || out.scene.budget.max_area_error)
        root.document().problems.add(root.line_of("budget"),
                                     "figures are drawn as they are, not measured; remove [budget]");
    root.finish();
    document.problems.throw_if_any();
    return out;
}

}  // namespace wrinkle::scene

namespace wrinkle {

Scene panel_scene(const Figure& figure, const Panel& panel) {
    Scene scene = figure.scene;
    std::erase_if(scene.layers, [&](const Layer& layer) { return !std::ranges::count(panel.layers, layer.name); });
    if (panel.picture != PanelPicture::lit) scene.lighting = {};
    scene.output = {};
    return scene;
}

}  // namespace wrinkle
