#pragma once

#include "cli/check_child.h"

namespace wrinkle::cli {

/// Prints what a device makes of kernels whose right results the program
/// carries, in two minutes at most. Throws Error where anything is out of its bounds, and where there is no such
/// device.
void check_device(const WantedCheck& wanted, bool json);

}  // namespace wrinkle::cli
