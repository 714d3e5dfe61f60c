#include "device/found_device.h"

#include "device/guarded.h"

namespace wrinkle {

namespace {

/// Lanes that fill the device's float vectors: 4, 8 or 16 on a CPU; a GPU has its own lanes.
int lanes_of(const cl::Device& device) {
    if ((device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) == 0) return 1;
    const unsigned width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    return width >= 16 ? 16 : width >= 8 ? 8 : 4;
}

}  // namespace

DeviceInfo describe_device(const cl::Device& device) {
    return guarded("ask an OpenCL device what it is", [&] {
        DeviceInfo info;
        info.platform = cl::Platform(device.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>();
        info.name = device.getInfo<CL_DEVICE_NAME>();
        info.driver = device.getInfo<CL_DRIVER_VERSION>();
        info.version = device.getInfo<CL_DEVICE_VERSION>();
        const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
        info.type = (type & CL_DEVICE_TYPE_CPU) != 0 ? "cpu" : (type & CL_DEVICE_TYPE_GPU) != 0 ? "gpu" : "accelerator";
        info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
        info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
        info.largest_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
        info.lanes = lanes_of(device);
        info.fp64 = device.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
        info.own_memory = info.type != "cpu" && device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == 0;
        return info;
    });
}

std::vector<FoundDevice> describe_devices(const std::vector<cl::Device>& devices) {
    std::vector<FoundDevice> found;
    for (const cl::Device& device : devices) {
        try {
            found.push_back({device, describe_device(device)});
        } catch (const Error&) { continue; }
    }
    return found;
}

}  // namespace wrinkle
