#include "wrinkle/device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "base/limits.h"
#include "device/choose_device.h"
#include "device/drivers.h"
#include "device/found_device.h"
#include "device/guarded.h"

namespace wrinkle {

namespace {

/// PoCL ends the process where it cannot start its threads, one a core, each with a stack; it does so when the loader
/// counts its devices. Drivers that are loaded before have taken what they take.
void check_room_for_threads() {
    if (std::isinf(address_room())) return;
    broken_drivers();
    constexpr double beside = 64e6, unlimited = 8e6;  // bytes: what drivers take meanwhile; a stack without a limit
    rlimit stack{};
    const bool limited = ::getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur != RLIM_INFINITY;
    const double threads = std::max(1u, std::thread::hardware_concurrency());
    const double wanted = beside + threads * (limited ? static_cast<double>(stack.rlim_cur) : unlimited);
    if (const double room = address_room(); room < wanted)
        throw Error(
            fmt::format("the limit of the process (ulimit -v) leaves {:.0f} MB of addresses; OpenCL's drivers "
                        "may take {:.0f} MB for their threads, and some end the program without",
                        std::max(room, 0.0) / 1e6, wanted / 1e6));
}

std::vector<FoundDevice> all_devices() {
    // PoCL 3.1 finds its devices when it is first asked for them, and tells threads that ask meanwhile of none.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    check_room_for_threads();
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
            fmt::format("no OpenCL device found. Install one: on Debian or Ubuntu \"apt-get install pocl-opencl-icd\" "
                        "runs on the CPU; GPUs bring an OpenCL ICD with their driver{}{}",
                        broken_drivers().empty() ? "" : ". Installed, but not to be loaded:\n  ",
                        fmt::join(broken_drivers(), "\n  ")));
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
        std::vector<DeviceInfo> infos;
        for (const FoundDevice& found : devices) infos.push_back(found.info);
        const char* standard = std::getenv("WRINKLE_DEVICE");
        const FoundDevice& chosen =
            devices[choose_device(infos, wanted.empty() && standard != nullptr ? standard : wanted)];
        const cl::Context context(chosen.device);
        const cl::CommandQueue queue(context, chosen.device, CL_QUEUE_PROFILING_ENABLE);
        return Device{chosen.device, context, queue, chosen.info};
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
