#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "python/bindings.h"
#include "python/progress.h"
#include "run/pass_impl.h"

namespace nb = nanobind;

namespace wrinkle::python {

namespace {

template <class Number, class Array>
auto spans(const std::map<std::string, Array>& arrays) {
    std::map<std::string, std::span<Number>> out;
    for (const auto& [name, array] : arrays) out.emplace(name, std::span<Number>(array.data(), array.size()));
    return out;
}

template <class Array>
void run(Pass& pass, const std::map<std::string, PlaneIn>& in, const std::map<std::string, Array>& out,
         std::optional<nb::callable> progress) {
    const auto inputs = spans<const float>(in);
    const auto outputs = spans<typename Array::Scalar>(out);
    Progress told(std::move(progress));
    told.around([&] { wrinkle::run(pass, inputs, outputs, [&](double share) { told(share); }); });
}

/// The same of planes in any formats, as arrays of bytes.
void run_bytes(Pass& pass, const std::map<std::string, BytesIn>& in, const std::map<std::string, BytesOut>& out,
               std::optional<nb::callable> progress) {
    HostBytes inputs;
    for (const auto& [name, array] : in) inputs.emplace(name, std::as_bytes(std::span(array.data(), array.size())));
    HostByteOutputs outputs;
    for (const auto& [name, array] : out)
        outputs.emplace(name, std::as_writable_bytes(std::span(array.data(), array.size())));
    Progress told(std::move(progress));
    told.around([&] { wrinkle::run(pass, inputs, outputs, [&](double share) { told(share); }); });
}

DevicePlanes buffers(const std::map<std::string, std::uintptr_t>& pointers) {
    DevicePlanes out;
    for (const auto& [name, pointer] : pointers) out.emplace(name, cl::Buffer(reinterpret_cast<cl_mem>(pointer), true));
    return out;
}

/// Enqueues on buffers made elsewhere. Returns the pointer of an event, which belongs to the caller.
std::uintptr_t enqueue(Pass& pass, const std::map<std::string, std::uintptr_t>& in,
                       const std::map<std::string, std::uintptr_t>& out, const std::vector<std::uintptr_t>& wait) {
    std::vector<cl::Event> events;
    for (const std::uintptr_t pointer : wait) events.emplace_back(reinterpret_cast<cl_event>(pointer), true);
    cl::Event done = pass.enqueue(buffers(in), buffers(out), events);
    clRetainEvent(done());
    return reinterpret_cast<std::uintptr_t>(done());
}

PassOptions options_of(int lanes, bool fp64, PlaneFormats formats) {
    return {.lanes = lanes, .fp64 = fp64, .output_formats = std::move(formats)};
}

}  // namespace

void bind_passes(nb::module_& module) {
    nb::class_<Pass>(module, "Pass", "A pass, built. For one thread at a time; each thread may have its own.")
        .def_prop_ro("inputs", &Pass::inputs, "planes that it reads")
        .def_prop_ro("outputs", &Pass::outputs, "planes that it writes")
        .def("set_camera", &Pass::set_camera, nb::arg("camera"))
        .def("set_scene", &Pass::set_parameters, nb::arg("scene"), nb::call_guard<nb::gil_scoped_release>())
        .def("run", &run<PlaneOut>, nb::arg("inputs"), nb::arg("outputs"), nb::arg("progress").none())
        .def("run", &run<DoublesOut>, nb::arg("inputs"), nb::arg("outputs"), nb::arg("progress").none())
        .def("run_bytes", &run_bytes, nb::arg("inputs"), nb::arg("outputs"), nb::arg("progress").none())
        .def_prop_ro("bytes_per_pixel", &Pass::bytes_per_pixel)
        .def("enqueue", &enqueue, nb::arg("inputs"), nb::arg("outputs"), nb::arg("wait"));
    module.def(
        "evaluate",
        [](const Device& device, const Scene& scene, const Frame& frame, int lanes, bool fp64, PlaneFormats formats) {
            return evaluate(device, scene, frame, options_of(lanes, fp64, std::move(formats)));
        },
        nb::arg("device"), nb::arg("scene"), nb::arg("frame"), nb::arg("lanes"), nb::arg("fp64"), nb::arg("formats"),
        nb::call_guard<nb::gil_scoped_release>());
    module.def(
        "accumulate_decals",
        [](const Device& device, const Scene& scene, const Frame& frame, int lanes, bool fp64, PlaneFormats formats) {
            return accumulate_decals(device, scene.layers, frame, options_of(lanes, fp64, std::move(formats)));
        },
        nb::arg("device"), nb::arg("scene"), nb::arg("frame"), nb::arg("lanes"), nb::arg("fp64"), nb::arg("formats"),
        nb::call_guard<nb::gil_scoped_release>());
    module.def(
        "screen_derivatives",
        [](const Device& device, const Frame& frame, int lanes, bool fp64, PlaneFormats formats) {
            return screen_derivatives(device, frame, options_of(lanes, fp64, std::move(formats)));
        },
        nb::arg("device"), nb::arg("frame"), nb::arg("lanes"), nb::arg("fp64"), nb::arg("formats"),
        nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace wrinkle::python
