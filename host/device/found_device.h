#pragma once

#include <vector>

#include "wrinkle/device.h"

namespace wrinkle {

/// A device and what it says of itself.
struct FoundDevice {
    cl::Device device;
    DeviceInfo info;
};

/// Throws Error where the device does not answer.
DeviceInfo describe_device(const cl::Device& device);

/// Those that answer, in their order: one broken driver does not keep the others from being used.
std::vector<FoundDevice> describe_devices(const std::vector<cl::Device>& devices);

}  // namespace wrinkle
