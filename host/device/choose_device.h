#pragma once

#include <span>
#include <string>

#include "wrinkle/device.h"

namespace wrinkle {

/// Which of the devices is `wanted`: its number, its type, or a part of its name, platform or version, whatever the
/// case
/// ("pocl" stands in PoCL's version). Empty: a GPU, else the CPU with the most vector lanes over all its compute units,
/// else the first. Throws Error listing the devices when there is none such.
std::size_t choose_device(std::span<const DeviceInfo> devices, const std::string& wanted);

}  // namespace wrinkle
