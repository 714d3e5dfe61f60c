#pragma once

#include <span>
#include <string>
#include <thread>

#include "wrinkle/device.h"

namespace wrinkle {

/// Which of the devices is `wanted`: its number, its type, or a part of its name, platform or version, whatever the
/// case ("pocl" stands in PoCL's version). Empty: a GPU, else the CPU that is the fastest by kFastestCpu, the first of
/// equal ones; else the first. `processors` are those of this machine; 0: as many as any device says. Throws Error
/// listing the devices when there is none such.
std::size_t choose_device(std::span<const DeviceInfo> devices, const std::string& wanted,
                          unsigned processors = std::thread::hardware_concurrency());

/// How CPUs are compared, as "wrinkle devices" prints it. A CPU device may tell of more compute units than there are
/// processors (llvmpipe: of eight, always), which makes none of them faster.
inline constexpr const char* kFastestCpu =
    "the CPU with the most lanes times compute units, counted up to the number of processors";

}  // namespace wrinkle
