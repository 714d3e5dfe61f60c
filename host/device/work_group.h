#pragma once

#include <algorithm>

#include "wrinkle/device.h"

namespace wrinkle {

/// The largest power of two, `wanted` at most, that the device can take as work-items of one group of this kernel: what
/// registers leave room for differs by kernel and device.
inline std::size_t work_group(const Device& device, const cl::Kernel& kernel, std::size_t wanted) {
    const auto allowed = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device.device);
    std::size_t size = 1;
    while (2 * size <= std::min(wanted, allowed)) size *= 2;
    return size;
}

}  // namespace wrinkle
