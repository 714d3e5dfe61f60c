#include "wrinkle/device.h"

#include <fmt/format.h>

#include <mutex>

#include "base/names.h"
#include "device/found_device.h"
#include "device/guarded.h"

namespace wrinkle {

namespace {

std::vector<FoundDevice> all_devices() {
    // PoCL 3.1 finds its devices when it is first asked for them, and tells threads that ask meanwhile of none.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
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
    std::vector<FoundDevice> found = describe_devices(devices);
    if (found.empty())
        throw Error(
            "no OpenCL device found. Install one: on Debian or Ubuntu \"apt-get install pocl-opencl-icd\" runs on the "
            "CPU; GPUs bring an OpenCL ICD with their driver");
    return found;
}

constexpr cl_command_queue_properties kOnDevice = 1 << 2;  // CL_QUEUE_ON_DEVICE, which headers of OpenCL 1.2 lack

}  // namespace

std::vector<DeviceInfo> list_devices() {
    return guarded("list the OpenCL devices", [] {
        std::vector<DeviceInfo> list;
        for (FoundDevice& found : all_devices()) list.push_back(std::move(found.info));
        return list;
    });
}

Device Device::open(const std::string& wanted) {
    return guarded("open an OpenCL device", [&] {
        const std::vector<FoundDevice> devices = all_devices();
        const std::string name = lower(wanted);
        const bool number = name.find_first_not_of("0123456789") == std::string::npos;
        std::string listing;
        const FoundDevice* chosen = nullptr;
        for (std::size_t i = 0; i < devices.size() && chosen == nullptr; ++i) {
            const DeviceInfo& info = devices[i].info;
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
            throw Error(
                fmt::format("no OpenCL device \"{}\"; give a number, a type (cpu, gpu) or a part of a name of:{}",
                            wanted, listing));
        const cl::Context context(chosen->device);
        const cl::CommandQueue queue(context, chosen->device, CL_QUEUE_PROFILING_ENABLE);
        return Device{chosen->device, context, queue, chosen->info};
    });
}

Device Device::adopt(const cl::Context& context, const cl::CommandQueue& queue) {
    return guarded("adopt an OpenCL queue", [&] {
        if (context() == nullptr || queue() == nullptr)
            throw Error("Device::adopt needs a context and a queue of it; one of them is null");
        if (queue.getInfo<CL_QUEUE_CONTEXT>()() != context())
            throw Error("Device::adopt needs a context and a queue of it; this queue is of another context");
        if ((queue.getInfo<CL_QUEUE_PROPERTIES>() & kOnDevice) != 0)
            throw Error("Device::adopt needs a queue that the host enqueues to; this one is on the device");
        const auto device = queue.getInfo<CL_QUEUE_DEVICE>();
        return Device{device, context, queue, describe_device(device)};
    });
}

}  // namespace wrinkle
