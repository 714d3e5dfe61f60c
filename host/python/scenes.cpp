#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <iterator>

#include "io/cryptomatte.h"
#include "layers/kinds.h"
#include "python/bindings.h"
#include "python/progress.h"
#include "scene/readers.h"
#include "tools/render.h"
#include "wrinkle/scene.h"

namespace nb = nanobind;

namespace wrinkle::python {

void bind_scenes(nb::module_& module) {
    nb::class_<Scene>(module, "Scene", "A scene, checked.")
        .def_static("load", &load_scene, nb::arg("file"), nb::call_guard<nb::gil_scoped_release>())
        .def_static(
            "parse",
            [](std::string_view text, const std::string& name, const std::filesystem::path& folder) {
                return scene::parse_scene(layer_kinds(), text, name, folder);
            },
            nb::arg("text"), nb::arg("name"), nb::arg("folder"), nb::call_guard<nb::gil_scoped_release>())
        .def_prop_ro("has_frame", [](const Scene& scene) { return !scene.gbuffer.file.empty(); })
        .def_prop_ro(
            "objects",
            [](const Scene& scene) {
                std::vector<std::string> names;
                const auto add = [&](const Mask& mask) {  // what patterns match, a frame knows
                    std::ranges::remove_copy_if(mask.cryptomatte, std::back_inserter(names), io::is_name_pattern);
                };
                if (scene.lighting.leave) add(*scene.lighting.leave);
                for (const Layer& layer : scene.layers) {
                    add(layer.mask);
                    const LayerKind& kind = kind_of(layer_kinds(), layer);
                    if (!kind.objects) continue;
                    for (const NamedObject& object : kind.objects(layer))
                        if (!object.cryptomatte.empty()) names.push_back(object.cryptomatte);
                }
                return names;
            },
            "the Cryptomatte names that its masks and tables use")
        .def_prop_ro("layers", [](const Scene& scene) {
            std::vector<std::string> names;
            for (const Layer& layer : scene.layers) names.push_back(layer.name);
            return names;
        });
    module.def("layer_kinds", [] {
        std::vector<std::string> names;
        for (const LayerKind* kind : layer_kinds()) names.emplace_back(kind->name);
        return names;
    });
    nb::class_<RenderReport>(module, "RenderReport", "What a run over the frames of a scene did.")
        .def_ro("pixels", &RenderReport::pixels)
        .def_ro("frames", &RenderReport::frames)
        .def_ro("wall", &RenderReport::wall, "seconds")
        .def_ro("kernel_ns_per_pixel", &RenderReport::kernel_ns_per_pixel)
        .def_ro("files", &RenderReport::files, "what was written")
        .def_ro("cameras", &RenderReport::cameras, "a line a frame: where it came from, and its residual")
        .def_ro("fitted_lights", &RenderReport::lights,
                "what lights were fitted to the picture, where the scene names none")
        .def_ro("warnings", &RenderReport::warnings);
    module.def(
        "run",
        [](const Scene& scene, std::filesystem::path directory, std::vector<int> frames, std::string device,
           std::optional<nb::callable> progress) {
            Progress told(std::move(progress));
            RenderOptions options;
            options.directory = std::move(directory), options.frames = std::move(frames);
            options.device = std::move(device);
            options.progress = [&](double share) { told(share); };
            return told.around([&] { return render(scene, options); });
        },
        nb::arg("scene"), nb::arg("directory"), nb::arg("frames"), nb::arg("device"), nb::arg("progress").none());
}

}  // namespace wrinkle::python
