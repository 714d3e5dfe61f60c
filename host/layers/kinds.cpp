#include "layers/kinds.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/only_errors.h"
#include "scene/check_scene.h"
#include "scene/readers.h"

namespace wrinkle {

namespace layers {
#include "layer_rows.inc"  // made by CMake: declares the row of every file of this folder, and lists them as `rows`
}

namespace {

using Bump = decltype(Layer::bump);
constexpr std::size_t kAlternatives = std::variant_size_v<Bump>;
static_assert(std::size(layers::rows) == kAlternatives, "a kind of Layer::bump has no file in layers/, or two");

template <std::size_t... I>
std::array<const LayerKind*, kAlternatives> by_alternative(std::index_sequence<I...>) {
    const auto row = [](std::string_view name) {
        return &(*std::ranges::find(layers::rows, name, [](const auto& of) { return std::string_view(of().name); }))();
    };
    return {row(std::variant_alternative_t<I, Bump>::kind)...};
}

}  // namespace

LayerKinds layer_kinds() {
    static const auto rows = by_alternative(std::make_index_sequence<kAlternatives>());
    return rows;
}

scene::SceneFile load_scene_file(const std::filesystem::path& file, const scene::SceneOptions& options) {
    return only_errors(file.c_str(), [&] { return scene::load_scene_file(layer_kinds(), file, options); });
}

Scene load_scene(const std::filesystem::path& file) { return load_scene_file(file, {}).scene; }

Figure load_figure(const std::filesystem::path& file) {
    return only_errors(file.c_str(), [&] { return scene::load_figure(layer_kinds(), file); });
}

void check(const Scene& scene) {
    only_errors("check a scene", [&] { scene::check_scene(layer_kinds(), scene); });
}

}  // namespace wrinkle
