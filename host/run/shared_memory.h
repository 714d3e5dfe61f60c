#pragma once

#include "wrinkle/passes.h"

namespace wrinkle {

/// Throws Error, naming both planes, where an output shares memory with an input or another output. Of the planes given
/// only those count that a pass reads (`inputs`) or writes (`outputs`).
void refuse_shared_memory(const DevicePlanes& in, const std::vector<std::string>& inputs, const DevicePlanes& out,
                          const std::vector<std::string>& outputs);
void refuse_shared_memory(const HostBytes& in, const std::vector<std::string>& inputs, const HostByteOutputs& out,
                          const std::vector<std::string>& outputs);

}  // namespace wrinkle
