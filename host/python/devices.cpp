#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstdint>

#include "python/bindings.h"
#include "wrinkle/device.h"
#include "wrinkle/error.h"

namespace nb = nanobind;

namespace wrinkle::python {

namespace {

/// An OpenCL object that another binding made, by its pointer, which PyOpenCL calls int_ptr.
template <class Handle>
Handle borrowed(std::uintptr_t pointer, const char* what) {
    if (pointer == 0) throw Error(std::string(what) + ": a null pointer is no OpenCL object");
    return Handle(reinterpret_cast<typename Handle::cl_type>(pointer), true);
}

}  // namespace

void bind_devices(nb::module_& module) {
    nb::class_<DeviceInfo>(module, "DeviceInfo", "What `wrinkle devices` lists of a device.")
        .def_ro("platform", &DeviceInfo::platform)
        .def_ro("name", &DeviceInfo::name)
        .def_ro("driver", &DeviceInfo::driver)
        .def_ro("version", &DeviceInfo::version)
        .def_ro("type", &DeviceInfo::type, "\"cpu\", \"gpu\" or \"accelerator\"")
        .def_ro("compute_units", &DeviceInfo::compute_units)
        .def_ro("memory", &DeviceInfo::memory, "bytes")
        .def_ro("lanes", &DeviceInfo::lanes, "pixels a work-item evaluates")
        .def_ro("fp64", &DeviceInfo::fp64)
        .def_ro("own_memory", &DeviceInfo::own_memory, "not the host's: a discrete GPU's")
        .def("__repr__", [](const DeviceInfo& d) { return "<wrinkle.DeviceInfo " + d.platform + ": " + d.name + ">"; });
    module.def("devices", &list_devices, "Every OpenCL device of this machine. Raises Error when there is none.");
    nb::class_<Device>(module, "Device", "An OpenCL device to work on: copies share the context and the queue.")
        .def_static("open", &Device::open, nb::arg("wanted") = "",
                    "The device whose number in devices() or type is `wanted`, or a part of its name, platform or "
                    "version; when empty WRINKLE_DEVICE, else a GPU, else the widest CPU. Raises Error listing the "
                    "devices when nothing matches.")
        .def_static(
            "adopt",
            [](std::uintptr_t context, std::uintptr_t queue) {
                return Device::adopt(borrowed<cl::Context>(context, "context"),
                                     borrowed<cl::CommandQueue>(queue, "queue"));
            },
            nb::arg("context"), nb::arg("queue"),
            "Works in a context and on a queue made elsewhere, given as pointers: PyOpenCL's `int_ptr`.")
        .def_ro("info", &Device::info);
}

}  // namespace wrinkle::python
