#include "wrinkle/device.h"

#include <fmt/format.h>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Lanes that fill the device's float vectors: 4, 8 or 16 on a CPU; a GPU has its own lanes.
int lanes_of(const cl::Device& device) {
    if ((device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) == 0) return 1;
    const unsigned width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    return width >= 16 ? 16 : width >= 8 ? 8 : 4;
}

DeviceInfo describe(const cl::Device& device) {
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
    return info;
}

std::vector<cl::Device> all_devices() {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        platforms.clear();  // the ICD loader reports "no platform" as an error
    }
    std::vector<cl::Device> devices;
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> some;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &some);
        } catch (const cl::Error&) {
            continue;  // a platform without devices
        }
        devices.insert(devices.end(), some.begin(), some.end());
    }
    if (devices.empty())
        throw Error(
            "no OpenCL device found. Install one: on Debian or Ubuntu \"apt-get install pocl-opencl-icd\" runs on the "
            "CPU; GPUs bring an OpenCL ICD with their driver");
    return devices;
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> list;
    for (const cl::Device& device : all_devices()) list.push_back(describe(device));
    return list;
}

Device Device::open(const std::string& wanted) {
    const std::vector<cl::Device> devices = all_devices();
    const std::string name = lower(wanted);
    const bool number = name.find_first_not_of("0123456789") == std::string::npos;
    std::string listing;
    const cl::Device* chosen = nullptr;
    for (std::size_t i = 0; i < devices.size() && chosen == nullptr; ++i) {
        const DeviceInfo info = describe(devices[i]);
        listing += fmt::format("\n  {}: {} ({}, {})", i, info.name, info.type, info.platform);
        const bool match =
            wanted.empty()
                ? info.type == "cpu"
                : name == fmt::format("{}", i) || name == info.type ||
                      (!number && name.size() > 1 &&
                       (contains_ignoring_case(info.name, name) || contains_ignoring_case(info.platform, name)));
        if (match) chosen = &devices[i];
    }
    if (chosen == nullptr && wanted.empty()) chosen = &devices.front();
    if (chosen == nullptr)
        throw Error(fmt::format("no OpenCL device \"{}\"; give a number, a type (cpu, gpu) or a part of a name of:{}",
                                wanted, listing));
    const cl::Context context(*chosen);
    return adopt(context, cl::CommandQueue(context, *chosen, CL_QUEUE_PROFILING_ENABLE));
}

Device Device::adopt(const cl::Context& context, const cl::CommandQueue& queue) {
    const auto device = queue.getInfo<CL_QUEUE_DEVICE>();
    return {device, context, queue, describe(device)};
}

}  // namespace wrinkle
