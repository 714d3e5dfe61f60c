#include "scene/check_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

/// Has the readers of scene files visit a copy of `scene`. They check it; what they normalise in the copy is not used.
Document visit(LayerKinds kinds, Scene scene, bool check_files) {
    Document document{{}, check_files, Problems("")};
    Table root(document, "the scene");
    read_scene(root, kinds, scene);
    return document;
}

std::string place_of(const Structure& value) { return fmt::format("{} in {}", quote(value.key), value.where); }

}  // namespace

std::vector<Structure> check_scene(LayerKinds kinds, const Scene& scene) {
    Document document = visit(kinds, scene, true);
    document.problems.throw_if_any();
    return std::move(document.structure);
}

std::vector<Structure> structure_of(LayerKinds kinds, const Scene& scene) {
    return visit(kinds, scene, false).structure;
}

std::vector<std::filesystem::path> files_of(LayerKinds kinds, const Scene& scene) {
    std::vector<std::filesystem::path> files{scene.file, scene.gbuffer.file, scene.gbuffer.beauty_file,
                                             scene.camera.file, scene.lighting.table_file};
    for (const Light& light : scene.lighting.lights) files.push_back(light.texture);
    for (const Layer& layer : scene.layers)
        if (const auto* const decals = std::get_if<DecalsLayer>(&layer.bump)) files.push_back(decals->file);
    for (const Structure& value : structure_of(kinds, scene)) files.emplace_back(value.value);
    return files;
}

void require_same_structure(const std::vector<Structure>& made, const std::vector<Structure>& wanted) {
    const auto same = [](const Structure& a, const Structure& b) { return a.key == b.key && a.value == b.value; };
    const auto [before, now] = std::ranges::mismatch(made, wanted, same);
    if (before == made.end() && now == wanted.end()) return;
    const Structure& value = now != wanted.end() ? *now : *before;
    const std::string was = now != wanted.end() && before != made.end() && before->key == value.key
                                ? fmt::format("is {} where the pass is made for {}", value.value, before->value)
                                : "differs from what the pass is made for";
    throw Error(fmt::format("{} {}, and that is compiled in; make another pass", place_of(value), was));
}

}  // namespace wrinkle::scene
